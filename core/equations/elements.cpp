#include "dalembert/core/equations/elements.h"

#include <algorithm>
#include <array>
#include <new>

namespace dalembert {

namespace {

/// The maps of the points of one element.
class MapsOf {
 public:
  MapsOf(const Elements& elements, std::size_t i)
      : count_(static_cast<std::size_t>(elements.type().maps)),
        many_(count_ > few ? count_ : 0),
        data_(many_.empty() ? few_.data() : many_.data()) {
    elements.type().point_maps(elements[i], data_);
  }
  MapsOf(const MapsOf&) = delete;
  MapsOf& operator=(const MapsOf&) = delete;
  [[nodiscard]] std::span<const detail::PointMap> all() const { return {data_, count_}; }

 private:
  static constexpr std::size_t few = 16;
  std::size_t count_;
  std::array<detail::PointMap, few> few_;
  std::vector<detail::PointMap> many_;
  detail::PointMap* data_;
};

}  // namespace

Elements::Elements(const Elements& other)
    : type_(other.type_),
      coordinates_(other.coordinates_),
      data_(other.copies(other.size_, other.size_, nullptr)),
      size_(other.size_),
      capacity_(other.size_) {}

Elements::~Elements() { release(data_, size_); }

std::byte* Elements::copies(std::size_t capacity, std::size_t i, const void* instead) const {
  if (capacity == 0) return nullptr;
  auto* const to =
      static_cast<std::byte*>(::operator new(capacity * type_->size, std::align_val_t(type_->alignment)));
  std::size_t done = 0;
  try {
    for (; done < size_; ++done) type_->copy(to + done * type_->size, done == i ? instead : (*this)[done]);
  } catch (...) {
    release(to, done);
    throw;
  }
  return to;
}

void Elements::release(std::byte* data, std::size_t size) const noexcept {
  if (data == nullptr) return;
  for (std::size_t i = 0; i < size; ++i) type_->destroy(data + i * type_->size);
  ::operator delete(data, std::align_val_t(type_->alignment));
}

void Elements::add(const void* element) {
  const std::size_t places = coordinates_.size();
  coordinates_.resize(places + static_cast<std::size_t>(type_->coordinates));
  try {
    type_->read(element, coordinates_.data() + places);
    if (size_ < capacity_) {
      type_->copy(data_ + size_ * type_->size, element);
    } else {
      const std::size_t capacity = std::max<std::size_t>(4, 2 * size_);
      std::byte* const to = copies(capacity, size_, nullptr);
      try {
        type_->copy(to + size_ * type_->size, element);
      } catch (...) {
        release(to, size_);
        throw;
      }
      release(data_, size_);
      data_ = to;
      capacity_ = capacity;
    }
    ++size_;
  } catch (...) {
    coordinates_.resize(places);
    throw;
  }
}

void Elements::replace(std::size_t i, const void* element) {
  if (type_->exchange != nullptr) {
    type_->exchange(data_ + i * type_->size, element);
  } else {
    std::byte* const to = copies(capacity_, i, element);
    release(data_, size_);
    data_ = to;
  }
  type_->read(element, coordinates_.data() + i * static_cast<std::size_t>(type_->coordinates));
}

void Elements::gather(std::size_t i, const Instant& at, double* inputs, double* rates) const {
  const int* const places = coordinates(i).data();
  if (type_->direct) {
    for (int k = 0; k < type_->coordinates; ++k) {
      inputs[k] = at.q[static_cast<std::size_t>(places[k])];
      rates[k] = at.v[static_cast<std::size_t>(places[k])];
    }
  } else {
    detail::gather_by(MapsOf(*this, i).all(), places, at.q.data(), at.v.data(), inputs, rates);
  }
}

void Elements::pull_back(std::size_t i, const double* gradient, double* out) const {
  if (type_->direct) {
    std::copy_n(gradient, type_->coordinates, out);
  } else {
    detail::pull_back_by(MapsOf(*this, i).all(), gradient, out);
  }
}

void Elements::pull_back_block(std::size_t i, const double* block, double* out) const {
  if (type_->direct) {
    const int n = type_->coordinates;
    for (int row = 0; row < n; ++row) {
      for (int column = 0; column < n; ++column) out[row * n + column] = block[column * n + row];
    }
  } else {
    detail::pull_back_block_by(MapsOf(*this, i).all(), block, out);
  }
}

void Elements::forces_at_points(int rows, std::span<const double> w, std::span<const double> lengths,
                                std::span<double> out) const {
  const auto n = static_cast<std::size_t>(rows), width = static_cast<std::size_t>(type_->coordinates),
             inputs = static_cast<std::size_t>(type_->inputs);
  for (std::size_t i = 0; i < size_; ++i) {
    const double* const own_w = w.data() + i * n * width;
    double* const own = out.data() + i * n * inputs;
    detail::forces_at_points(MapsOf(*this, i).all(), rows, own_w, coordinates(i), lengths, own);
  }
}

}  // namespace dalembert
