#include "dalembert/view/glb.h"

#include <algorithm>
#include <array>
#include <bit>
#include <span>
#include <sstream>

namespace dalembert {

namespace {

static_assert(std::endian::native == std::endian::little, "glTF is little-endian");

constexpr int of_vertices = 34962, of_indices = 34963;  // targets of buffer views
constexpr int as_float = 5126, as_uint16 = 5123;        // types of components

/// The binary part of a file, and how its numbers are found.
class Buffer {
 public:
  /// Vectors of so many components; their number.
  std::size_t add(const std::vector<float>& numbers, std::size_t components, int target = 0) {
    View view{bytes_.size(),
              numbers.size() * sizeof(float),
              numbers.size() / components,
              as_float,
              target,
              components,
              {},
              {}};
    for (std::size_t k = 0; k < components; ++k) {
      view.least.push_back(numbers[k]);
      view.most.push_back(numbers[k]);
      for (std::size_t i = k; i < numbers.size(); i += components) {
        view.least[k] = std::min(view.least[k], numbers[i]);
        view.most[k] = std::max(view.most[k], numbers[i]);
      }
    }
    append(numbers.data(), view.length);
    views_.push_back(std::move(view));
    return views_.size() - 1;
  }
  std::size_t add(const std::vector<std::uint16_t>& numbers) {
    views_.push_back({bytes_.size(),
                      numbers.size() * sizeof numbers[0],
                      numbers.size(),
                      as_uint16,
                      of_indices,
                      1,
                      {},
                      {}});
    append(numbers.data(), views_.back().length);
    return views_.size() - 1;
  }
  std::size_t add(const std::vector<Eigen::Vector3f>& vectors) {
    std::vector<float> numbers;
    for (const auto& one : vectors) numbers.insert(numbers.end(), one.begin(), one.end());
    return add(numbers, 3, of_vertices);
  }

  void write_views(Json& json) const {
    json.list("buffers", std::array{bytes_.size()},
              [&](std::size_t length) { json.object([&] { json.member("byteLength", length); }); });
    json.list("bufferViews", views_, [&](const View& view) {
      json.object([&] {
        json.member("buffer", 0);
        json.member("byteOffset", view.offset);
        json.member("byteLength", view.length);
        if (view.target != 0) json.member("target", view.target);
      });
    });
    std::size_t number = 0;
    json.list("accessors", views_, [&](const View& view) {
      json.object([&] {
        json.member("bufferView", number++);
        json.member("componentType", view.type);
        json.member("count", view.count);
        json.member("type", view.components == 1 ? "SCALAR" : view.components == 3 ? "VEC3" : "VEC4");
        if (view.least.empty()) return;
        json.list("min", view.least, [&](float x) { json.value(static_cast<double>(x)); });
        json.list("max", view.most, [&](float x) { json.value(static_cast<double>(x)); });
      });
    });
  }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  struct View {
    std::size_t offset, length, count;
    int type, target;
    std::size_t components;
    std::vector<float> least, most;
  };

  void append(const void* data, std::size_t length) {
    bytes_.append(static_cast<const char*>(data), length);
    bytes_.resize((bytes_.size() + 3) / 4 * 4);
  }

  std::string bytes_{};
  std::vector<View> views_{};
};

/// A property of a node over time, as glTF counts its components.
struct Track {
  const char* path;
  std::size_t node, components;
  std::vector<float> numbers;

  [[nodiscard]] bool moves() const {
    for (std::size_t i = components; i < numbers.size(); ++i)
      if (numbers[i] != numbers[i - components]) return true;
    return false;
  }
};

class GltfScene {
 public:
  explicit GltfScene(const Animation& animation) : animation_(animation) {
    for (const Solid& solid : animation.solids)
      meshes_.push_back(
          {buffer_.add(solid.corners), buffer_.add(solid.normals), buffer_.add(solid.triangles)});
    for (std::size_t i = 0; i < animation.moving.size(); ++i) add_tracks(animation.moving[i], i);
    if (std::ranges::none_of(tracks_, &Track::moves)) return;
    times_ = buffer_.add(animation.times, 1);
    for (const Track& track : tracks_)
      if (track.moves()) channels_.push_back({&track, buffer_.add(track.numbers, track.components)});
  }

  void write(std::ostream& out) const {
    Json json(out);
    json.object([&] {
      json.object("asset", [&] {
        json.member("version", "2.0");
        json.member("generator", "dalembert " DALEMBERT_VERSION);
      });
      json.member("scene", 0);
      json.list("scenes", std::array{animation_.moving.size()}, [&](std::size_t root) {
        json.object([&] {
          json.member("name", animation_.name);
          json.member("nodes", std::vector{root});
        });
      });
      write_nodes(json);
      write_meshes(json);
      if (!channels_.empty()) write_animation(json);
      buffer_.write_views(json);
    });
  }
  [[nodiscard]] const std::string& bytes() const { return buffer_.bytes(); }

 private:
  struct Mesh {
    std::size_t corners, normals, triangles;
  };
  struct Channel {
    const Track* track;
    std::size_t output;
  };

  static void append(std::vector<float>& numbers, const auto& vector) {
    for (int k = 0; k < vector.size(); ++k) numbers.push_back(static_cast<float>(vector[k]));
  }
  void add_tracks(const MovingSolid& its, std::size_t node) {
    Track place{"translation", node, 3, {}}, turned{"rotation", node, 4, {}}, size{"scale", node, 3, {}};
    for (const auto& r : its.place) append(place.numbers, r);
    for (const auto& q : its.turned) append(turned.numbers, q.coeffs());  // x, y, z, w
    for (const auto& s : its.size) append(size.numbers, s);
    for (Track* track : {&place, &turned, &size})
      if (!track->numbers.empty()) tracks_.push_back(std::move(*track));
  }

  void write_nodes(Json& json) const {
    std::vector<std::size_t> all(animation_.moving.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
    std::vector<std::size_t> with_root = all;
    with_root.push_back(all.size());
    json.list("nodes", with_root, [&](std::size_t i) {
      json.object([&] {
        if (i == all.size()) {
          json.member("name", animation_.name);
          if (!all.empty()) json.member("children", all);
          std::vector<float> turned;
          append(turned, animation_.turned.coeffs());
          write_start(json, "rotation", turned, 4);
          return;
        }
        json.member("name", animation_.moving[i].name);
        json.member("mesh", animation_.moving[i].solid);
        for (const Track& track : tracks_)
          if (track.node == i) write_start(json, track.path, track.numbers, track.components);
      });
    });
  }
  static void write_start(Json& json, const char* path, std::span<const float> numbers, std::size_t count) {
    json.list(path, numbers.first(count), [&](float x) { json.value(static_cast<double>(x)); });
  }

  void write_meshes(Json& json) const {
    std::size_t number = 0;
    json.list("meshes", meshes_, [&](const Mesh& mesh) {
      json.object([&] {
        json.list("primitives", std::array{number++}, [&](std::size_t material) {
          json.object([&] {
            json.object("attributes", [&] {
              json.member("POSITION", mesh.corners);
              json.member("NORMAL", mesh.normals);
            });
            json.member("indices", mesh.triangles);
            json.member("material", material);
          });
        });
      });
    });
    json.list("materials", animation_.colours, [&](const Eigen::Vector3f& colour) {
      json.object([&] {
        json.object("pbrMetallicRoughness", [&] {
          const std::array<float, 4> opaque{colour[0], colour[1], colour[2], 1.0F};
          json.list("baseColorFactor", opaque, [&](float x) { json.value(static_cast<double>(x)); });
          json.member("metallicFactor", 0.1);
          json.member("roughnessFactor", 0.6);
        });
      });
    });
  }

  void write_animation(Json& json) const {
    json.list("animations", std::array{0}, [&](int) {
      json.object([&] {
        json.member("name", "run");
        std::size_t sampler = 0;
        json.list("channels", channels_, [&](const Channel& channel) {
          json.object([&] {
            json.member("sampler", sampler++);
            json.object("target", [&] {
              json.member("node", channel.track->node);
              json.member("path", channel.track->path);
            });
          });
        });
        json.list("samplers", channels_, [&](const Channel& channel) {
          json.object([&] {
            json.member("input", times_);
            json.member("output", channel.output);
          });
        });
      });
    });
  }

  const Animation& animation_;
  Buffer buffer_{};
  std::vector<Mesh> meshes_{};
  std::vector<Track> tracks_{};
  std::vector<Channel> channels_{};
  std::size_t times_ = 0;
};

void put(std::ostream& out, std::uint32_t number) {
  out.write(reinterpret_cast<const char*>(&number), sizeof number);
}

}  // namespace

void write_glb(std::ostream& out, const Animation& animation) {
  const GltfScene scene(animation);
  std::ostringstream text;
  scene.write(text);
  std::string json = std::move(text).str();
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::string& bytes = scene.bytes();
  constexpr std::uint32_t magic = 0x46546C67, version = 2, of_json = 0x4E4F534A, of_bytes = 0x004E4942;
  for (const std::uint32_t number :
       {magic, version, static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + bytes.size()),
        static_cast<std::uint32_t>(json.size()), of_json})
    put(out, number);
  out << json;
  put(out, static_cast<std::uint32_t>(bytes.size()));
  put(out, of_bytes);
  out << bytes;
}

}  // namespace dalembert
