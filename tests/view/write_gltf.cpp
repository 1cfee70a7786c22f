#include <dalembert/dalembert.h>
#include <dalembert/view/write_gltf.h>

#define BOOST_BIND_GLOBAL_PLACEHOLDERS  // which Boost 1.74 asks for
#include <Eigen/Geometry>
#include <boost/property_tree/json_parser.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <numbers>
#include <sstream>

namespace dalembert::write_gltf_test {
namespace {

using boost::property_tree::ptree;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double pi = std::numbers::pi;
/// Numbers of an animation are of single precision: a few roundings of them.
constexpr double single = 4.0 * std::numeric_limits<float>::epsilon();

std::filesystem::path file_of_test() {
  const auto* const test = ::testing::UnitTest::GetInstance()->current_test_info();
  return std::filesystem::temp_directory_path() / (std::string("dalembert-gltf-") + test->name() + ".glb");
}

/// An animation, read as the specification of glTF 2.0 says.
class Glb {
 public:
  explicit Glb(const Trajectory<2>& run) { read(run); }
  explicit Glb(const Trajectory<3>& run) { read(run); }

  [[nodiscard]] const ptree& json() const { return json_; }
  /// The vectors of a property of a node at all times; one if it does not change.
  [[nodiscard]] std::vector<Eigen::VectorXd> track(const std::string& node, const std::string& path) const {
    const auto [number, its] = find(node);
    if (const auto channels = json_.get_child_optional("animations..channels")) {
      for (const auto& [key, channel] : *channels) {
        if (channel.get<std::size_t>("target.node") != number ||
            channel.get<std::string>("target.path") != path)
          continue;
        const ptree& sampler = at("animations..samplers", channel.get<std::size_t>("sampler"));
        EXPECT_EQ(sampler.get<std::size_t>("input"), json_.get<std::size_t>("animations..samplers..input"));
        return accessor(sampler.get<std::size_t>("output"));
      }
    }
    std::vector<double> numbers;
    for (const auto& [key, one] : its->get_child(path)) numbers.push_back(one.get_value<double>());
    return {Eigen::Map<const Eigen::VectorXd>(numbers.data(), static_cast<Eigen::Index>(numbers.size()))};
  }
  [[nodiscard]] Eigen::Quaterniond rotation(const std::string& node, std::size_t i) const {
    const auto all = track(node, "rotation");
    const Eigen::VectorXd& q = all[std::min(i, all.size() - 1)];
    return {q[3], q[0], q[1], q[2]};
  }
  [[nodiscard]] std::vector<Eigen::VectorXd> times() const {
    return accessor(json_.get<std::size_t>("animations..samplers..input"));
  }

 private:
  template <int D>
  void read(const Trajectory<D>& run) {
    const auto path = file_of_test();
    write_gltf(run, path);
    std::ifstream in(path, std::ios::binary);
    const std::string all{std::istreambuf_iterator<char>(in), {}};
    std::filesystem::remove(path);
    const auto word = [&all](std::size_t at) {
      std::uint32_t number = 0;
      std::memcpy(&number, all.data() + at, sizeof number);
      return number;
    };
    ASSERT_EQ(all.substr(0, 4), "glTF");
    ASSERT_EQ(word(4), 2U);
    ASSERT_EQ(word(8), all.size());
    const std::size_t length = word(12);
    ASSERT_EQ(all.substr(16, 4), "JSON");
    ASSERT_EQ(length % 4, 0U);
    std::istringstream text(all.substr(20, length));
    read_json(text, json_);
    ASSERT_EQ(all.substr(20 + length + 4, 4), std::string("BIN\0", 4));
    ASSERT_EQ(20 + length + 8 + word(20 + length), all.size());
    bytes_ = all.substr(20 + length + 8);
    ASSERT_EQ(json_.get<std::size_t>("buffers..byteLength"), bytes_.size());
  }
  [[nodiscard]] const ptree& at(const std::string& list, std::size_t number) const {
    auto one = json_.get_child(list).begin();
    std::advance(one, number);
    return one->second;
  }
  [[nodiscard]] std::pair<std::size_t, const ptree*> find(const std::string& name) const {
    std::size_t number = 0;
    for (const auto& [key, node] : json_.get_child("nodes")) {
      if (node.get<std::string>("name") == name) return {number, &node};
      ++number;
    }
    throw Error("no node \"" + name + '"');
  }
  [[nodiscard]] std::vector<Eigen::VectorXd> accessor(std::size_t number) const {
    const ptree &its = at("accessors", number), &view = at("bufferViews", its.get<std::size_t>("bufferView"));
    EXPECT_EQ(its.get<int>("componentType"), 5126);  // float
    const auto type = its.get<std::string>("type");
    const Eigen::Index width = type == "SCALAR" ? 1 : type == "VEC3" ? 3 : 4;
    std::vector<float> numbers(view.get<std::size_t>("byteLength") / sizeof(float));
    std::memcpy(numbers.data(), bytes_.data() + view.get<std::size_t>("byteOffset"),
                numbers.size() * sizeof(float));
    const Eigen::MatrixXd all = Eigen::Map<const Eigen::MatrixXf>(
                                    numbers.data(), width, static_cast<Eigen::Index>(numbers.size()) / width)
                                    .cast<double>();
    EXPECT_EQ(its.get<Eigen::Index>("count"), all.cols());
    std::vector<Eigen::VectorXd> vectors;
    for (Eigen::Index i = 0; i < all.cols(); ++i) vectors.emplace_back(all.col(i));
    return vectors;
  }

  ptree json_;
  std::string bytes_;
};

struct Pendulum {
  Scene<2> scene{"pendulum"};
  Particle<2> bob;

  explicit Pendulum(Vec<2> start) {
    scene.add(UniformGravity<2>{{0.0, -9.81}});
    bob = scene.add_particle({.mass = 1.0, .position = start}, "bob");
    scene.add(Distance{Fixed<2>{}, bob, 1.0}, "rod");
  }
};

TEST(WriteGltf, AParticleIsWhereTheRunHasIt) {
  const Pendulum pendulum({1.0, 0.0});
  const auto run = simulate(pendulum.scene, {.t_end = 3.0, .t_start = 2.0, .samples = 11});
  const Glb glb(run);
  const auto times = glb.times(), places = glb.track("bob", "translation");
  ASSERT_EQ(times.size(), run.size());
  ASSERT_EQ(places.size(), run.size());
  for (std::size_t i = 0; i < run.size(); ++i) {
    EXPECT_NEAR(times[i][0], run.times()[i] - 2.0, single);
    EXPECT_LT((places[i].head<2>() - run.position(pendulum.bob, i)).norm(), single);
    EXPECT_EQ(places[i][2], 0.0);
  }
}

TEST(WriteGltf, ARodLeadsFromOnePointToTheOther) {
  const Pendulum pendulum({1.0, 0.0});
  const auto run = simulate(pendulum.scene, {.t_end = 10.0, .samples = 101});
  const Glb glb(run);
  const auto middle = glb.track("rod", "translation"), size = glb.track("rod", "scale");
  for (std::size_t i = 0; i < run.size(); ++i) {
    const Vec<2> r = run.position(pendulum.bob, i);
    const double length = size[std::min(i, size.size() - 1)][2];
    const Vec<3> half = glb.rotation("rod", i) * Vec<3>(0.0, 0.0, length / 2.0);
    // About 100 least rotations follow each other, each with a rounding of double precision.
    EXPECT_LT((middle[i] - Vec<3>(r.x() / 2.0, r.y() / 2.0, 0.0)).norm(), single);
    EXPECT_LT((half - Vec<3>(r.x() / 2.0, r.y() / 2.0, 0.0)).norm(), single);
  }
}

/// No least rotation leads to the opposite direction, and any half turn does.
TEST(WriteGltf, ARodThatIsTurnedBackLeadsToItsOtherEnd) {
  Scene<3> scene("whirl");
  const auto bob =
      scene.add_particle({.mass = 1.0, .position = {0.0, 0.0, -1.0}, .velocity = {pi, 0.0, 0.0}});
  scene.add(Distance{Fixed<3>{}, bob, 1.0}, "rod");
  const auto run = simulate(scene, {.t_end = 4.0, .samples = 5});  // half turns
  const Glb glb(run);
  for (std::size_t i = 0; i < run.size(); ++i) {
    const Vec<3> along = glb.rotation("rod", i) * Vec<3>(0.0, 0.0, 1.0);
    EXPECT_LT((along - run.position(bob, i)).norm(), single) << i;
  }
}

TEST(WriteGltf, ABodyIsTheBoxOfItsInertiaAndTurnsWithIt) {
  constexpr double a = 0.1, b = 0.2, c = 0.3, mass = 2.0, rate = 3.0;  // half edges of a uniform box
  Scene<3> scene("top");
  const auto body =
      add_body(scene,
               BodyState<3>{.mass = mass,
                            .inertia = mass / 3.0 * Vec<3>(b * b + c * c, a * a + c * c, a * a + b * b),
                            .angular_velocity = {0.0, 0.0, rate}},
               "box");
  const auto run = simulate(scene, {.t_end = 5.0, .samples = 51, .tolerance = 1e-8});
  const Glb glb(run);
  auto size = glb.track("box", "scale").front();
  std::ranges::sort(size);
  EXPECT_LT((size - Vec<3>(a, b, c)).norm(), 10.0 * single);  // by an eigenvalue problem
  const Eigen::Quaterniond start = glb.rotation("box", 0);
  for (std::size_t i = 0; i < run.size(); ++i) {
    const Eigen::Quaterniond turned = glb.rotation("box", i) * start.inverse();
    // What the run has: its error at 1e-8 is no matter.
    const Eigen::Matrix3d due = body.axes(run.sample(i)) * body.axes(run.sample(0)).transpose();
    EXPECT_LT((turned.toRotationMatrix() - due).norm(), 10.0 * single);
    EXPECT_NEAR(glb.rotation("box", i).norm(), 1.0, single);
    if (i > 0) {
      EXPECT_GT(glb.rotation("box", i).dot(glb.rotation("box", i - 1)), 0.0);
    }
  }
}

TEST(WriteGltf, HasYUpwards) {
  Scene<3> scene("space");
  scene.add_particle({.mass = 1.0, .position = {1.0, 2.0, 3.0}}, "p");
  const Glb glb(simulate(scene, {.t_end = 1.0, .samples = 2}));
  const Vec<3> up = glb.rotation("space", 0) * Vec<3>::UnitZ();
  EXPECT_LT((up - Vec<3>::UnitY()).norm(), single);
}

TEST(WriteGltf, HasNoAnimationAtRest) {
  const Glb glb(simulate(Pendulum({0.0, -1.0}).scene, {.t_end = 1.0, .samples = 3}));
  EXPECT_FALSE(glb.json().get_child_optional("animations"));
  EXPECT_EQ(glb.track("bob", "translation").size(), 1U);
}

TEST(WriteGltf, RefusesAnotherEndingAndAFolderThatIsNotThere) {
  const auto run = simulate(Pendulum({1.0, 0.0}).scene, {.t_end = 0.1, .samples = 2});
  EXPECT_THAT([&] { write_gltf(run, "run.gltf"); }, ThrowsMessage<InvalidArgument>(HasSubstr(".glb")));
  EXPECT_THAT([&] { write_gltf(run, "no-such-folder/run.glb"); },
              ThrowsMessage<Error>(HasSubstr("no-such-folder")));
}

/// From 1e-38 to 3e38: JSON has no infinite numbers, and of a scene of 1e-60 all would be 0.
TEST(WriteGltf, NamesWhatIsBeyondSinglePrecision) {
  const auto write = [](double length, double speed, double t_end) {
    Scene<2> scene;
    scene.add_particle({.mass = 1.0, .position = {length, 0.0}, .velocity = {speed, 0.0}}, "far");
    write_gltf(simulate(scene, {.t_end = t_end, .samples = 3}), file_of_test());
  };
  EXPECT_THAT([&] { write(1e60, 0.0, 1.0); },
              ThrowsMessage<InvalidArgument>(
                  AllOf(HasSubstr("\"far\", 1e+60"), HasSubstr("single precision"), HasSubstr("units"))));
  EXPECT_THAT([&] { write(0.0, 1e-60, 1.0); },
              ThrowsMessage<InvalidArgument>(HasSubstr("size of the scene")));
  EXPECT_THAT([&] { write(0.0, 1e-60, 1e60); },
              ThrowsMessage<InvalidArgument>(HasSubstr("length of the run")));
  write(1.0, 1e-60, 1.0);  // rests, for single precision
}

}  // namespace
}  // namespace dalembert::write_gltf_test
