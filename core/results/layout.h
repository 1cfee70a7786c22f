#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace dalembert {

/// Names and places: where each particle and constraint of a scene stands in the flat arrays.
struct Layout {
  struct Particle {
    std::string name;
    int coordinate;  ///< first of its `dimension` entries in q and v
    double mass;
  };
  struct Rotor {
    std::string name;
    int coordinate;
    double inertia;
  };
  struct Constraint {
    std::string kind;
    std::string name;
    int rows;
    int width;       ///< coordinates it acts on
    int inputs;      ///< numbers of the positions of its points
    bool internal;   ///< holds a body together; its user did not state it
    int first_row;   ///< in lambda
    int first_slot;  ///< in the slots of constraint forces, `width` of them

    [[nodiscard]] std::string label() const { return kind + " \"" + name + '"'; }
  };

  std::string scene;
  std::uint64_t id = 0;  ///< identity of the scene, to refuse handles of another
  int dimension = 0;
  std::vector<Particle> particles;
  std::vector<Rotor> rotors;
  std::vector<Constraint> constraints;
  std::vector<int> slot_coordinate;  ///< the coordinate that each slot's force acts on
};

}  // namespace dalembert
