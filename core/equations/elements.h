#pragma once

#include <dalembert/core/equations/arguments.h>
#include <dalembert/core/equations/point_maps.h>

#include <cstddef>
#include <new>
#include <span>
#include <type_traits>
#include <typeinfo>
#include <vector>

namespace dalembert {

/// What must be known of a type of constraints or forces to hold elements of it, whatever it is.
struct ElementType {
  const std::type_info* type;
  std::size_t size, alignment;
  int inputs, coordinates;  ///< numbers of the positions of its points, and entries of q that it reads
  int maps;                 ///< points that have inputs
  bool direct;              ///< whether the inputs simply are the coordinates
  void (*copy)(void* to, const void* from);
  void (*destroy)(void*) noexcept;
  /// Puts a copy in the place of an element without ever leaving none there; null where that may fail.
  void (*exchange)(void* element, const void* with);
  void (*read)(const void* element, int* coordinates);
  void (*point_maps)(const void* element, detail::PointMap* maps);
};

namespace detail {

template <class E>
[[nodiscard]] constexpr int count_moving_points() {
  return []<class... P>(std::type_identity<std::tuple<P...>>) {
    return (0 + ... + (P::inputs > 0));
  }(std::type_identity<PointTuple<E>>{});
}

template <class E>
void read_places(const void* element, int* coordinates) {
  for_each_moving_point(*static_cast<const E*>(element), [&coordinates](const auto& point) {
    for (const int place : point.reads()) *coordinates++ = place;
  });
}

template <class E>
void write_point_maps(const void* element, PointMap* maps) {
  for_each_moving_point(*static_cast<const E*>(element), [&maps]<class P>(const P& point) {
    static_assert(P::inputs <= PointMap::most_inputs);
    if constexpr (P::inputs == P::coordinates) {
      *maps++ = {nullptr, P::inputs, P::coordinates};
    } else {
      *maps++ = {point.map().data(), P::inputs, P::coordinates};
    }
  });
}

template <class E>
void exchange_element(void* element, const void* with) {
  E copy(*static_cast<const E*>(with));  // a lambda that captures cannot be assigned
  static_cast<E*>(element)->~E();
  ::new (element) E(std::move(copy));
}

}  // namespace detail

template <class E>
[[nodiscard]] constexpr ElementType element_type_of() {
  ElementType its{.type = &typeid(E),
                  .size = sizeof(E),
                  .alignment = alignof(E),
                  .inputs = PointFacts<E>::inputs,
                  .coordinates = PointFacts<E>::coordinates,
                  .maps = detail::count_moving_points<E>(),
                  .direct = PointFacts<E>::direct,
                  .copy = [](void* to, const void* from) { ::new (to) E(*static_cast<const E*>(from)); },
                  .destroy = [](void* element) noexcept { static_cast<E*>(element)->~E(); },
                  .exchange = nullptr,
                  .read = &detail::read_places<E>,
                  .point_maps = &detail::write_point_maps<E>};
  if constexpr (std::is_nothrow_move_constructible_v<E>) its.exchange = &detail::exchange_element<E>;
  return its;
}

/// Elements of one type and the entries of q that they read, held without knowing the type: compiled once.
/// Whatever throws as an element is copied, nothing has changed.
class Elements {
 public:
  explicit Elements(const ElementType& type) : type_(&type) {}
  Elements(const Elements& other);
  Elements& operator=(const Elements&) = delete;
  ~Elements();

  void add(const void* element);
  void replace(std::size_t i, const void* element);

  [[nodiscard]] const ElementType& type() const { return *type_; }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] const void* data() const { return data_; }
  [[nodiscard]] const void* operator[](std::size_t i) const { return data_ + i * type_->size; }
  [[nodiscard]] std::span<const int> coordinates() const { return coordinates_; }
  [[nodiscard]] std::span<const int> coordinates(std::size_t i) const {
    const auto width = static_cast<std::size_t>(type_->coordinates);
    return coordinates().subspan(i * width, width);
  }

  /// The inputs of an element, and their rates.
  void gather(std::size_t i, const Instant& at, double* inputs, double* rates) const;
  /// A gradient with respect to the inputs of an element, as one with respect to its coordinates.
  void pull_back(std::size_t i, const double* gradient, double* out) const;
  /// A matrix of second derivatives likewise; `block` by columns, `out` by rows.
  void pull_back_block(std::size_t i, const double* block, double* out) const;
  /// See detail::forces_at_points; `rows` rows of w and of `out` per element.
  void forces_at_points(int rows, std::span<const double> w, std::span<const double> lengths,
                        std::span<double> out) const;

 private:
  /// Room for `capacity` elements with copies of all there are, `instead` in the place of number `i`.
  [[nodiscard]] std::byte* copies(std::size_t capacity, std::size_t i, const void* instead) const;
  void release(std::byte* data, std::size_t size) const noexcept;

  const ElementType* type_;
  std::vector<int> coordinates_;  // before what a destructor of ours would have to free: its copy may fail
  std::byte* data_ = nullptr;
  std::size_t size_ = 0, capacity_ = 0;
};

}  // namespace dalembert
