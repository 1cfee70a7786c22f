#include <dalembert/dalembert.h>
#include <dalembert/view/body_boxes.h>
#include <dalembert/view/level_set.h>
#include <dalembert/view/write_html.h>

#define BOOST_BIND_GLOBAL_PLACEHOLDERS  // which Boost 1.74 asks for
#include <Eigen/Geometry>
#include <boost/property_tree/json_parser.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>
#include <sstream>

namespace dalembert::write_html_test {
namespace {

using boost::property_tree::ptree;

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

std::vector<std::uint8_t> from_base64(const std::string& text) {
  const std::string alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<std::uint8_t> bytes;
  std::uint32_t bits = 0, count = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6U | static_cast<std::uint32_t>(alphabet.find(c));
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<std::uint8_t>(bits >> count));
  }
  return bytes;
}

/// A page, read by other means than it was written.
class Page {
 public:
  explicit Page(const std::filesystem::path& file) : text_(text_of(file)) {
    const std::string begin = "<script id=\"data\" type=\"application/json\">";
    const std::size_t first = text_.find(begin) + begin.size();
    std::istringstream json(text_.substr(first, text_.find("</script>", first) - first));
    read_json(json, data_);
  }
  const std::string& text() const { return text_; }
  const ptree& data() const { return data_; }
  /// A member of the first constraint, particle, ... by its path.
  const ptree& first(const std::string& list) const { return data_.get_child(list).front().second; }
  /// The numbers of a column; those of one that does not change once.
  std::vector<double> column(const ptree& number) const {
    auto all = data_.get_child("columns").begin();
    std::advance(all, number.get_value<int>());
    const auto bytes = from_base64(all->second.get<std::string>("data"));
    std::vector<double> numbers;
    const auto size = data_.get<std::size_t>("bytes");
    for (std::size_t k = 0; k + size <= bytes.size(); k += size) {
      std::uint64_t bits = 0;
      for (std::size_t i = size; i-- > 0;) bits = bits << 8U | bytes[k + i];
      numbers.push_back(size == 8 ? std::bit_cast<double>(bits)
                                  : std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
    }
    return numbers;
  }

 private:
  std::string text_;
  ptree data_;
};

class WriteHtml : public testing::Test {
 protected:
  WriteHtml() {
    scene.add(UniformGravity<2>{{0.0, -9.81}});
    bob = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}}, "bob");
    rod = scene.add(Distance{Fixed<2>{}, bob, 1.0}, "rod");
  }
  template <class Shown>
  Page page_of(const Shown& shown, const PageOptions& options = {}) const {
    write_html(shown, file, options);
    return Page(file);
  }
  ~WriteHtml() override { std::filesystem::remove(file); }

  const std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) /
      (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".html");
  Scene<2> scene{"pendulum"};
  Particle<2> bob;
  Constraint<1> rod;
};

TEST_F(WriteHtml, HasTheNumbersOfTheRunToTheBit) {
  const auto run = simulate(scene, {.t_end = 1.0, .samples = 11});
  const Page page = page_of(run);
  const ptree& particle = page.first("particles");
  const ptree& its_rod = page.first("constraints");
  const auto times = page.column(page.data().get_child("time"));
  const auto y = page.column(std::next(particle.get_child("position").begin())->second);
  const auto lambda = page.column(its_rod.get_child("lambda").front().second);
  const auto force =
      page.column(its_rod.get_child("arrows").front().second.get_child("force").front().second);
  ASSERT_EQ(lambda.size(), run.size());
  for (std::size_t i = 0; i < run.size(); ++i) {
    EXPECT_EQ(times[i], run.times()[i]);
    EXPECT_EQ(y[i], run.position(bob, i).y());
    EXPECT_EQ(lambda[i], run.multiplier(rod, i));
    EXPECT_EQ(force[i], run.constraint_force(rod, bob, i).x());
  }
  EXPECT_EQ(its_rod.get<std::string>("shape"), "rod");
}

TEST_F(WriteHtml, HasTheErrorsOfTheCertificate) {
  const auto certificate = certify(scene, {.t_end = 1.0, .samples = 6});
  const Page page = page_of(certificate);
  const auto of_force = page.column(page.first("constraints").get_child("error"));
  const auto of_place = page.column(page.first("particles").get_child("positionError"));
  const auto of_speed = page.column(page.first("particles").get_child("velocityError"));
  for (std::size_t i = 0; i < certificate.run().size(); ++i) {
    EXPECT_EQ(of_force[i], certificate.multiplier_error(rod, i));
    EXPECT_EQ(of_place[i], certificate.position_error(bob, i));
    EXPECT_EQ(of_speed[i], certificate.velocity_error(bob, i));
  }
  EXPECT_EQ(page.data().get<std::string>("certificate.statement"), certificate.statement());
}

TEST_F(WriteHtml, ShowsEventsBeforeAndAfter) {
  Scene<2> ball("ball");
  ball.add(UniformGravity<2>{{0.0, -10.0}});
  const auto p =
      ball.add_particle({.mass = 1.0, .position = {0.0, 5.0}}, "ball");  // falls for 1 at last at 10
  ball.add(unilateral(OnCurve{p, Plane<2>{}}, {.restitution = 0.5}), "floor");
  const auto run = simulate(ball, {.t_end = 1.5, .samples = 4});
  const Page page = page_of(run);
  const ptree& event = page.first("events");
  const auto row = event.get<std::size_t>("row");
  const auto vy = page.column(std::next(page.first("particles").get_child("velocity").begin())->second);
  EXPECT_EQ(event.get<std::string>("what"), "is struck");
  EXPECT_EQ(event.get<std::string>("name"), "floor");
  EXPECT_EQ(run.name_of(run.events()[0]), "floor");
  EXPECT_STREQ(name(run.events()[0].kind), "is struck");
  EXPECT_EQ(vy[row], run.event_sample(0).velocity(p).y());
  EXPECT_EQ(vy[row + 1], run.sample_after(0).velocity(p).y());
  EXPECT_NEAR(vy[row], -10.0, 1e-4);
  EXPECT_NEAR(vy[row + 1], 5.0, 1e-4);
}

TEST_F(WriteHtml, NamesAreNoHtml) {
  Scene<2> odd("</script><script>alert(1)</script>");
  const auto p = odd.add_particle({.mass = 1.0, .position = {1.0, 0.0}}, "<b>\"p\\\"\n&");
  odd.add(Distance{Fixed<2>{}, p, 1.0}, "<!--");
  const Page page = page_of(simulate(odd, {.t_end = 0.1, .samples = 2}), {.title = "</SCRIPT >"});
  EXPECT_EQ(page.text().find("alert(1)</script>"), std::string::npos);
  EXPECT_EQ(page.text().find("</SCRIPT >"), std::string::npos);
  EXPECT_EQ(page.data().get<std::string>("scene"), "</script><script>alert(1)</script>");
  EXPECT_EQ(page.data().get<std::string>("title"), "</SCRIPT >");
  EXPECT_EQ(page.first("particles").get<std::string>("name"), "<b>\"p\\\"\n&");
}

/// Well-formed characters of two, three and four bytes stay as they are. Of the rest each byte is U+FFFD:
/// Latin-1, an overlong '/', half a surrogate pair, what is cut off.
TEST_F(WriteHtml, NamesThatAreNotUtf8AreShownAsSuch) {
  const std::string right = "\xc3\xa9 \xe2\x82\xac \xf0\x9f\x99\x82", none = "\xef\xbf\xbd";
  for (const std::string wrong : {"\xe9", "\xc0\xaf", "\xed\xa0\x80", "\xf0\x9f\x99"}) {
    Scene<2> odd(right + wrong + right + wrong);
    odd.add_particle({.mass = 1.0});
    const Page page = page_of(simulate(odd, {.t_end = 0.1, .samples = 2, .length = 1.0}));
    std::string shown;
    for (std::size_t k = 0; k < wrong.size(); ++k) shown += none;
    EXPECT_EQ(page.data().get<std::string>("scene"), right + shown + right + shown);
  }
}

TEST_F(WriteHtml, AForceThatIsNotDeterminedIsNoNumber) {
  auto record = std::make_shared<Record>(*simulate(scene, {.t_end = 1.0, .samples = 3}).record());
  record->values[record->stride() + 3 * record->coordinates] = std::numeric_limits<double>::quiet_NaN();
  const Page page = page_of(Trajectory<2>(record));
  const auto lambda = page.column(page.first("constraints").get_child("lambda").front().second);
  EXPECT_FALSE(std::isnan(lambda[0]));
  EXPECT_TRUE(std::isnan(lambda[1]));
  EXPECT_FALSE(std::isnan(lambda[2]));
}

TEST_F(WriteHtml, ALargePageKeepsFewerDigitsAndThenFewerSamples) {
  const auto run = simulate(scene, {.t_end = 1.0, .samples = 1001});
  // 12 columns of 1001 numbers, of 8 bytes in base64: 128 kB, 7 digits take half of that.
  const Page shorter = page_of(run, {.most_bytes = 100'000});
  EXPECT_EQ(shorter.data().get<int>("digits"), 7);
  EXPECT_EQ(shorter.data().get<int>("every"), 1);
  const Page thinner = page_of(run, {.most_bytes = 30'000});
  EXPECT_EQ(thinner.data().get<int>("digits"), 7);
  EXPECT_GT(thinner.data().get<int>("every"), 1);
  EXPECT_EQ(thinner.data().get<int>("samples"), 1001);
  EXPECT_LT(shorter.text().size() - thinner.text().size(), 100'000U);
  EXPECT_EQ(thinner.column(thinner.data().get_child("time")).back(), 1.0F);
}

TEST_F(WriteHtml, RefusesARunWithoutSamples) {
  auto record = std::make_shared<Record>(*simulate(scene, {.t_end = 1.0, .samples = 2}).record());
  record->clear();
  try {
    write_html(Trajectory<2>(record), file);
    FAIL();
  } catch (const InvalidArgument& error) {
    EXPECT_NE(std::string(error.what()).find("\"pendulum\" has no samples"), std::string::npos)
        << error.what();
  }
}

TEST_F(WriteHtml, RefusesAPathThatCannotBeWritten) {
  const auto run = simulate(scene, {.t_end = 0.1, .samples = 2});
  EXPECT_THROW(write_html(run, file / "no" / "folder.html"), Error);
}

TEST_F(WriteHtml, DrawsWhatTheSceneStates) {
  Scene<2> all("all");
  const auto a = all.add_particle({.mass = 1.0, .position = {1.0, 0.0}}, "a");
  const auto b = all.add_particle({.mass = 1.0, .position = {2.0, 0.0}}, "b");
  all.add(OnCurve{a, Translating{Plane<2>{}, [](auto t) { return vec(0.0, 0.1 * t); }}}, "lift");
  all.add(holonomic(points(a, b), [](auto r_a, auto r_b) { return (r_b - r_a).norm() - 1.0; }), "own");
  all.add(holonomic(points(b), [](auto r) { return r.y() - 0.05 * (r.x() - 2.0) - 0.1; }), "slope");
  all.add(Spring{driven([](auto t) { return vec(1.0, sin(t)); }), a, 10.0}, "spring");
  const Page page = page_of(simulate(all, {.t_end = 0.2, .samples = 3, .assemble = true}));
  std::vector<std::string> shapes;
  for (const auto& [_, constraint] : page.data().get_child("constraints"))
    shapes.push_back(constraint.get<std::string>("shape"));
  EXPECT_EQ(shapes, (std::vector<std::string>{"plane", "lines", "implicit"}));
  const ptree& lift = page.first("constraints");
  auto pose = lift.get_child("pose").begin();
  std::advance(pose, 7);  // the shift along y
  EXPECT_NEAR(page.column(pose->second).back(), 0.1 * 0.2, 1e-15);
  EXPECT_FALSE(std::prev(page.data().get_child("constraints").end())->second.get_child("levelSet").empty());
  const ptree& spring = page.first("forces");
  EXPECT_EQ(spring.get<std::string>("shape"), "spring");
  const ptree& path = spring.get_child("points").front().second.get_child("path");
  EXPECT_EQ(page.column(std::next(path.begin())->second).back(), std::sin(0.2));
}

TEST_F(WriteHtml, ATorqueOfAHingeIsTheMomentOfTheWeight) {
  // A body at rest, its centre a beside a vertical hinge: the hinge holds it with -m g a about y.
  Scene<3> shelf("shelf");
  const double m = 2.0, g = 10.0, a = 0.5;
  shelf.add(UniformGravity<3>{{0.0, 0.0, -g}});
  const auto board =
      add_body(shelf, BodyState<3>{.mass = m, .inertia = {0.3, 0.4, 0.5}, .centre = {a, 0.0, 0.0}}, "board");
  shelf.add(Revolute{Ground<3>{}, board, {0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}}, "hinge");
  const Page page = page_of(simulate(shelf, {.t_end = 0.1, .samples = 2, .tolerance = 1e-8}));
  const ptree& arrows = page.first("constraints").get_child("arrows");
  ASSERT_EQ(arrows.size(), 2U);
  const ptree& torque = std::next(arrows.begin())->second;
  EXPECT_TRUE(torque.get<bool>("torque"));
  const auto component = [&](int k) {
    return page.column(std::next(torque.get_child("force").begin(), k)->second).front();
  };
  const double promised = 100.0 * 1e-8 * m * g;  // force of constraint at the start, to the tolerance
  EXPECT_NEAR(component(0), 0.0, promised);
  EXPECT_NEAR(component(1), -m * g * a, promised);
  EXPECT_NEAR(component(2), 0.0, promised);
}

TEST_F(WriteHtml, ShowsWhenAConstraintIsReleased) {
  const Event<2> lets_go{.name = "lets go",
                         .function = [](const Sample<2>& now) { return now.time() - 0.55; },
                         .change = [rod = rod](Scene<2>& changed) { changed.release(rod); }};
  const Page page = page_of(simulate(scene, {.t_end = 1.0, .samples = 11}, {lets_go}));
  EXPECT_EQ(page.first("events").get<std::string>("name"), "lets go");
  // Samples at 0 to 0.5, the event before and after, samples at 0.6 to 1.
  std::vector<double> expected(13, 1.0);
  std::fill_n(expected.begin(), 7, 0.0);
  EXPECT_EQ(page.column(page.first("constraints").get_child("released")), expected);
}

TEST(BodyBoxes, HaveTheInertiaOfTheBody) {
  Scene<3> scene("body");
  const Vec<3> h(0.5, 0.2, 0.1);  // half edges of a uniform box
  const Vec<3> square = h.cwiseAbs2();
  const double m = 3.0;
  const Vec<3> inertia = m / 3.0 * (Vec<3>::Constant(square.sum()) - square);
  (void)add_body(scene, BodyState<3>{.mass = m, .inertia = inertia, .centre = {1.0, 2.0, 3.0}}, "box");
  const auto run = simulate(scene, {.t_end = 1.0, .samples = 2});
  const auto boxes = body_boxes(run.sample(0).layout(), run.sample(0).flat());
  ASSERT_EQ(boxes.size(), 1U);
  ASSERT_EQ(boxes[0].axes.size(), 3U);
  EXPECT_EQ(boxes[0].name, "box");
  for (std::size_t k = 0; k < 3; ++k) {
    const SketchedPoint& axis = boxes[0].axes[k];
    Vec<3> edge = Vec<3>::Zero();
    for (std::size_t row = 0; row < 3; ++row)
      for (std::size_t i = 0; i < axis.coordinates.size(); ++i)
        edge[static_cast<int>(row)] += axis.map[row * axis.coordinates.size() + i] *
                                       run.sample(0).flat().q[static_cast<std::size_t>(axis.coordinates[i])];
    EXPECT_NEAR(edge.norm(), h[static_cast<int>(k)], 1e-13);  // round-off of a few hundred operations
  }
}

TEST(LevelSet, CircleIsARoundPolygon) {
  const auto circle = [](const Sketch::Place& r) { return std::hypot(r[0], r[1]) - 1.0; };
  const Eigen::AlignedBox3d box(Vec<3>(-1.5, -1.5, 0.0), Vec<3>(1.5, 1.5, 0.0));
  const int cells = 60;
  const auto segments = level_set(circle, box, 2, cells);
  ASSERT_FALSE(segments.empty());
  double length = 0.0;
  for (std::size_t k = 0; k < segments.size(); k += 4) {
    const Vec<2> a(segments[k], segments[k + 1]), b(segments[k + 2], segments[k + 3]);
    length += (b - a).norm();
    // Linear interpolation over edges of length s <= sqrt 2 h is off by s^2/8 times the curvature, here 1.
    EXPECT_NEAR(a.norm(), 1.0, 2.0 * std::pow(3.0 / cells, 2) / 8.0 * 1.1);
  }
  EXPECT_NEAR(length, 2.0 * std::numbers::pi, 1e-2);
}

TEST(LevelSet, SphereIsClosed) {
  const auto sphere = [](const Sketch::Place& r) { return std::hypot(r[0], r[1], r[2]) - 1.0; };
  const Eigen::AlignedBox3d box(Vec<3>::Constant(-1.3), Vec<3>::Constant(1.3));
  const auto triangles = level_set(sphere, box, 3, 20);
  double area = 0.0;
  for (std::size_t k = 0; k < triangles.size(); k += 9) {
    const auto corner = [&](std::size_t i) { return Vec<3>::from(&triangles[k + 3 * i]); };
    area += 0.5 * (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm();
  }
  EXPECT_NEAR(area, 4.0 * std::numbers::pi,
              0.02 * 4.0 * std::numbers::pi);  // of chords, h = 0.13: h^2 over the radius
}

}  // namespace
}  // namespace dalembert::write_html_test
