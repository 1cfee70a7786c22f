#include "dalembert/view/moving_parts.h"

#include <dalembert/view/body_boxes.h>

#include <algorithm>

namespace dalembert {

MovingParts::MovingParts(const Layout& layout, Quantities& all) : layout_(&layout), all_(&all) {
  for (const auto& p : layout.particles)
    particles_.push_back(moving(p.coordinate, layout.dimension, Kind::position, Kind::velocity));
  for (const auto& r : layout.rotors)
    rotors_.push_back(moving(r.coordinate, 1, Kind::angle, Kind::angular_velocity));
}

MovingParts::Moving MovingParts::moving(int first, int count, Kind position, Kind velocity) {
  const auto part = [first, count](auto member) {
    return [=](const FlatSample& at, std::span<double> out) {
      std::ranges::copy(
          (at.*member).subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(count)),
          out.begin());
    };
  };
  const auto q = part(&FlatSample::q), v = part(&FlatSample::v), a = part(&FlatSample::a);
  return {all_->add(count, q), all_->add(count, v), all_->add(count, a), all_->add_error(count, position, q),
          all_->add_error(count, velocity, v)};
}

void MovingParts::write_moving(Json& json, const Moving& its) {
  json.member("position", its.q);
  json.member("velocity", its.v);
  json.member("acceleration", its.a);
  write_error(json, its.position_error, "positionError");
  write_error(json, its.velocity_error, "velocityError");
}

void MovingParts::write_particles(Json& json) const {
  std::size_t k = 0;
  json.list("particles", layout_->particles, [&](const auto& p) {
    json.object([&] {
      json.member("name", p.name);
      json.member("mass", p.mass);
      json.member("coordinate", p.coordinate);
      write_moving(json, particles_[k++]);
    });
  });
}

void MovingParts::write_rotors(Json& json) const {
  std::size_t k = 0;
  json.list("rotors", layout_->rotors, [&](const auto& r) {
    json.object([&] {
      json.member("name", r.name);
      json.member("inertia", r.inertia);
      json.member("coordinate", r.coordinate);
      write_moving(json, rotors_[k++]);
    });
  });
}

void MovingParts::write_bodies(Json& json, const Pictures& pictures) const {
  json.list("bodies", body_boxes(*layout_, all_->shown().front().sample()), [&](const BodyBox& body) {
    json.object([&] {
      json.member("name", body.name);
      json.member("particles", body.particles);
      json.list("places", std::vector{body.centre},
                [&](const auto& p) { pictures.write_point(json, p, {}); });
      json.list("axes", body.axes, [&](const auto& p) { pictures.write_point(json, p, {}); });
      json.list("touched", body.touched, [&](const auto& p) { pictures.write_point(json, p, {}); });
    });
  });
}

void MovingParts::write(Json& json, const Pictures& pictures) const {
  write_particles(json);
  write_rotors(json);
  write_bodies(json, pictures);
}

}  // namespace dalembert
