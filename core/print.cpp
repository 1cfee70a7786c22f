#include <dalembert/core/vec.h>

#include <algorithm>
#include <ostream>
#include <sstream>
#include <string>

namespace dalembert::detail {

void print(std::ostream& out, const double* x, int rows, int cols) {
  const auto width_of = [&out](double number) {
    std::ostringstream text;
    text.copyfmt(out);
    text.width(0);
    text << number;
    return static_cast<int>(text.str().size());
  };
  int width = 0;
  for (int i = 0; i < rows * cols; ++i) width = std::max(width, width_of(x[i]));
  for (int i = 0; i < rows; ++i) {
    if (i > 0) out << '\n';
    for (int k = 0; k < cols; ++k) {
      if (k > 0) out << ' ';
      out.width(width);
      out << x[k * rows + i];
    }
  }
}

}  // namespace dalembert::detail
