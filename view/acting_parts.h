#pragma once

#include <dalembert/core/results/trajectory.h>
#include <dalembert/view/pictures.h>

#include <optional>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// Constraints and forces of a page: their pictures, multipliers, and the arrows of their forces.
class ActingParts {
 public:
  ActingParts(const Record& run, Quantities& all, Pictures& pictures);
  void write(Json& json, const Pictures& pictures) const;

 private:
  using Kind = Quantities::Kind;
  using Numbers = Pictures::Numbers;
  /// The force of a constraint on one of its points.
  struct Arrow {
    std::size_t point;
    Numbers force;
    std::optional<std::size_t> error;
    bool torque;  ///< on the body of that point, or on a rotor
  };
  struct Acting {
    const Layout::Constraint* constraint;
    Pictures::Drawn drawn;
    std::vector<Arrow> arrows;
    Numbers lambda;
    std::optional<std::size_t> error;
    Numbers unique;                         ///< none if all always are
    std::optional<std::size_t> released{};  ///< whether it is out of force, if it ever is
  };

  [[nodiscard]] Acting acting(const Layout::Constraint& constraint, Pictures& pictures);
  void add_arrows(Acting& its);
  [[nodiscard]] std::optional<std::size_t> released(std::size_t constraint);
  [[nodiscard]] std::optional<Arrow> torque_arrow(const Acting& its);
  void write_constraint(Json& json, const Acting& its, const Pictures& pictures) const;
  void write_forces(Json& json, const Pictures& pictures) const;

  const Record* run_;
  const Layout* layout_;
  Quantities* all_;
  std::vector<Acting> constraints_;
  std::vector<Pictures::Drawn> forces_;
};

}  // namespace dalembert
