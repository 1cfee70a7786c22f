#pragma once

#include <dalembert/core/mat.h>

#include <cstddef>

namespace dalembert {

/// A quantity of `Rows` numbers at all samples of a run, a column each: a view into the run. As a matrix of
/// Eigen it is copied: `const Eigen::Matrix2Xd r = run.positions(bob);`.
template <int Rows>
class AtAllSamples {
 public:
  /// Of numbers that lie `stride` apart from sample to sample.
  AtAllSamples(const double* first, std::size_t samples, std::size_t stride)
      : first_(first), samples_(samples), stride_(stride) {}

  /// Of samples.
  [[nodiscard]] std::size_t size() const { return samples_; }
  /// Of numbers at each sample.
  [[nodiscard]] static constexpr int rows() { return Rows; }
  /// Of samples, as Eigen counts.
  [[nodiscard]] std::ptrdiff_t cols() const { return static_cast<std::ptrdiff_t>(samples_); }
  /// One number, not checked.
  [[nodiscard]] double operator()(int row, std::size_t i) const {
    return first_[i * stride_ + static_cast<std::size_t>(row)];
  }
  /// At sample i: a number, or a vector of several.
  [[nodiscard]] auto operator[](std::size_t i) const {
    if constexpr (Rows == 1) {
      return (*this)(0, i);
    } else {
      return Vec<Rows>::from(first_ + i * stride_);
    }
  }
  /// At sample i.
  [[nodiscard]] Vec<Rows> col(std::size_t i) const { return Vec<Rows>::from(first_ + i * stride_); }
  /// One of its numbers at all samples.
  [[nodiscard]] AtAllSamples<1> row(int k) const { return {first_ + k, samples_, stride_}; }

  /// @{
  /// The largest and the smallest number of all; of no samples 0, and NaN counts as none.
  [[nodiscard]] double maxCoeff() const {
    return extreme([](double x, double far) { return x > far; });
  }
  [[nodiscard]] double minCoeff() const {
    return extreme([](double x, double far) { return x < far; });
  }
  /// @}
  /// The largest length of the vectors: the highest speed, of velocities.
  [[nodiscard]] double largest_norm() const {
    double largest = 0.0;
    for (std::size_t i = 0; i < samples_; ++i) {
      const double norm = col(i).norm();
      largest = norm > largest ? norm : largest;
    }
    return largest;
  }
  /// As one of Eigen's, for who has included Eigen.
  operator Eigen::Matrix<double, Rows, -1, Rows == 1, Rows, -1>() const {  // NOLINT
    Eigen::Matrix<double, Rows, -1, Rows == 1, Rows, -1> all(Rows, cols());
    for (std::size_t i = 0; i < samples_; ++i)
      for (int k = 0; k < Rows; ++k) all(k, static_cast<std::ptrdiff_t>(i)) = (*this)(k, i);
    return all;
  }

 private:
  template <class Beyond>
  [[nodiscard]] double extreme(const Beyond& beyond) const {
    double far = samples_ > 0 ? *first_ : 0.0;
    for (std::size_t i = 0; i < samples_; ++i)
      for (int k = 0; k < Rows; ++k)
        if (beyond((*this)(k, i), far) || far != far) far = (*this)(k, i);
    return far;
  }

  const double* first_;
  std::size_t samples_, stride_;
};

}  // namespace dalembert
