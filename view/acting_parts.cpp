#include "dalembert/view/acting_parts.h"

#include <algorithm>

namespace dalembert {

ActingParts::ActingParts(const Record& run, Quantities& all, Pictures& pictures)
    : run_(&run), layout_(run.layout.get()), all_(&all) {
  for (const auto& constraint : layout_->constraints)
    if (!constraint.internal) constraints_.push_back(acting(constraint, pictures));
  for (const auto& force : layout_->forces)
    forces_.push_back(force.drawing ? pictures.drawn(*force.drawing) : Pictures::Drawn{});
}

ActingParts::Acting ActingParts::acting(const Layout::Constraint& constraint, Pictures& pictures) {
  Acting its{.constraint = &constraint,
             .drawn = pictures.drawn(*constraint.drawing),
             .arrows = {},
             .lambda = {},
             .error = {},
             .unique = {}};
  const auto lambda = [own = constraint.own_rows()](const FlatSample& at, std::span<double> out) {
    std::ranges::copy(own.in(at.lambda), out.begin());
  };
  its.lambda = all_->add(constraint.rows, lambda);
  its.error = all_->add_error(constraint.rows, Kind::force, lambda);
  if (!run_->unique.empty())
    its.unique = all_->add(constraint.rows,
                           [own = constraint.own_rows()](const FlatSample& at, std::span<double> out) {
                             std::ranges::copy(own.in(at.unique), out.begin());
                           });
  add_arrows(its);
  its.released = released(static_cast<std::size_t>(&constraint - layout_->constraints.data()));
  return its;
}

/// An event may change it: then the layout does.
std::optional<std::size_t> ActingParts::released(std::size_t constraint) {
  const auto out = [constraint](const Layout& layout) { return layout.conditions->of[constraint].released; };
  const auto ever = [&](const auto& later) { return out(*later.layout); };
  if (!out(*layout_) && std::ranges::none_of(run_->later, ever)) return {};
  return all_->columns().add([&](std::size_t i) {
    const Shown& shown = all_->shown()[i];
    return out(*shown.record->layout_of(shown.number)) ? 1.0 : 0.0;
  });
}

/// The force on a point of a body is the sum of those on its particles: the weights of a place add up to 1.
void ActingParts::add_arrows(Acting& its) {
  std::size_t slot = static_cast<std::size_t>(its.constraint->first_slot);
  const auto& points = its.drawn.drawing->points;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const std::size_t count = points[k].coordinates.size(), first = slot;
    slot += count;
    if (count == 0 || points[k].direction) continue;
    const int numbers = points[k].rotor ? 1 : layout_->dimension;
    const auto force = [=](const FlatSample& at, std::span<double> out) {
      std::ranges::fill(out, 0.0);
      for (std::size_t i = 0; i < count; ++i) out[i % out.size()] += at.forces[first + i];
    };
    its.arrows.push_back(
        {k, all_->add(numbers, force), all_->add_error(numbers, Kind::other, force), points[k].rotor});
  }
  if (auto torque = torque_arrow(its)) its.arrows.push_back(std::move(*torque));
}

/// On the second body of a joint, or the first if that is the ground: sum r_i x f_i over what the forces at
/// its directions are on its particles; as these add up to 0 it does not depend on the origin.
std::optional<ActingParts::Arrow> ActingParts::torque_arrow(const Acting& its) {
  const auto& points = its.drawn.drawing->points;
  std::optional<std::size_t> place;
  for (std::size_t k = 0; k < points.size(); ++k)
    if (!points[k].direction && !points[k].rotor && !points[k].map.empty()) place = k;
  if (!place) return {};
  const std::vector<int>& coordinates = points[*place].coordinates;
  std::vector<std::size_t> slots;  // the first one of each direction
  std::size_t slot = static_cast<std::size_t>(its.constraint->first_slot);
  for (const SketchedPoint& point : points) {
    if (point.direction && point.coordinates == coordinates) slots.push_back(slot);
    slot += point.coordinates.size();
  }
  if (slots.empty()) return {};
  const int D = layout_->dimension, numbers = D == 2 ? 1 : 3;
  const auto torque = [slots, coordinates, D](const FlatSample& at, std::span<double> out) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero(), r = sum, f = sum;
    for (const std::size_t first : slots) {
      for (std::size_t i = 0; i < coordinates.size(); ++i) {
        const int k = static_cast<int>(i) % D;
        r[k] = at.q[static_cast<std::size_t>(coordinates[i])];
        f[k] = at.forces[first + i];
        if (k == D - 1) sum += r.cross(f);
      }
    }
    if (D == 2) {
      out[0] = sum.z();
    } else {
      std::ranges::copy(sum, out.begin());
    }
  };
  return Arrow{*place, all_->add(numbers, torque), all_->add_error(numbers, Kind::other, torque), true};
}

void ActingParts::write_constraint(Json& json, const Acting& its, const Pictures& pictures) const {
  const Layout::Constraint& c = *its.constraint;
  const auto index = &c - layout_->constraints.data();
  const Condition& holds = layout_->conditions->of[static_cast<std::size_t>(index)];
  json.object([&] {
    json.member("index", index);
    json.member("kind", c.kind);
    json.member("name", c.name);
    json.member("meaning", c.meaning);
    if (holds.contact) json.member("oneSided", holds.contact->sign());
    if (holds.roughness) json.member("pressedBy", holds.roughness->pressed_by);
    pictures.write(json, its.drawn);
    json.member("lambda", its.lambda);
    write_error(json, its.error);
    if (!its.unique.empty()) json.member("unique", its.unique);
    if (its.released) json.member("released", *its.released);
    json.list("arrows", its.arrows, [&](const Arrow& arrow) {
      json.object([&] {
        json.member("point", arrow.point);
        json.member("force", arrow.force);
        json.member("torque", arrow.torque);
        write_error(json, arrow.error);
      });
    });
  });
}

void ActingParts::write_forces(Json& json, const Pictures& pictures) const {
  std::size_t k = 0;
  json.list("forces", layout_->forces, [&](const auto& force) {
    json.object([&] {
      json.member("kind", force.kind);
      json.member("name", force.name);
      pictures.write(json, forces_[k++]);
    });
  });
}

void ActingParts::write(Json& json, const Pictures& pictures) const {
  json.list("constraints", constraints_, [&](const Acting& its) { write_constraint(json, its, pictures); });
  write_forces(json, pictures);
}

}  // namespace dalembert
