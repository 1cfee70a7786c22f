#pragma once

#include <dalembert/view/pictures.h>

#include <optional>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// Particles, rotors and bodies of a page, with columns of how they move.
class MovingParts {
 public:
  MovingParts(const Layout& layout, Quantities& all);
  void write(Json& json, const Pictures& pictures) const;

 private:
  using Kind = Quantities::Kind;
  /// A particle or rotor.
  struct Moving {
    Pictures::Numbers q, v, a;
    std::optional<std::size_t> position_error, velocity_error;
  };
  [[nodiscard]] Moving moving(int first, int count, Kind position, Kind velocity);
  static void write_moving(Json& json, const Moving& its);
  void write_particles(Json& json) const;
  void write_rotors(Json& json) const;
  void write_bodies(Json& json, const Pictures& pictures) const;

  const Layout* layout_;
  Quantities* all_;
  std::vector<Moving> particles_, rotors_;
};

}  // namespace dalembert
