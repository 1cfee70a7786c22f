#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/view/json.h>

#include <cstddef>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// How many bytes of a number a page keeps.
enum class Digits : std::size_t { seven = 4, sixteen = 8 };

/// The numbers of a page, a column for each quantity and a row for each instant. A column that does not
/// change is one number.
class Columns {
 public:
  explicit Columns(std::size_t rows) : rows_(rows) {}

  /// Of `f(row)`; its number, by which the rest of the page names it.
  template <class F>
  std::size_t add(const F& f) {
    std::vector<double> column(rows_);
    for (std::size_t i = 0; i < rows_; ++i) column[i] = f(i);
    return keep(std::move(column));
  }
  /// What all of them take in base64.
  [[nodiscard]] std::size_t bytes(Digits digits) const;
  /// As little-endian IEEE numbers in base64.
  void write(Json& json, Digits digits) const;

 private:
  std::size_t keep(std::vector<double> column);

  std::size_t rows_;
  std::vector<std::vector<double>> all_;
};

}  // namespace dalembert
