#pragma once

#include <dalembert/solvers/base/hidden.h>

#include <charconv>
#include <cmath>
#include <concepts>
#include <ostream>
#include <string_view>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// Writes JSON, of which no character can end a script element of HTML. What is no finite number is null.
class Json {
 public:
  explicit Json(std::ostream& out) : out_(out) {}

  void value(std::string_view text);
  void value(const char* text) { value(std::string_view(text)); }
  void value(const std::string& text) { value(std::string_view(text)); }
  void value(bool yes) { put(yes ? "true" : "false"); }
  void value(double number);
  void value(std::integral auto number) { put(std::to_string(number)); }
  template <class T>
  void value(const std::vector<T>& all) {
    list(all, [this](const T& one) { value(one); });
  }

  template <class T>
  void member(std::string_view name, const T& its) {
    key(name);
    value(its);
  }
  /// `f()` writes the members.
  template <class F>
  void object(const F& f) {
    open('{');
    f();
    close('}');
  }
  template <class F>
  void object(std::string_view name, const F& f) {
    key(name);
    object(f);
  }
  /// `f(one)` writes each.
  template <class Range, class F>
  void list(const Range& all, const F& f) {
    open('[');
    for (const auto& one : all) f(one);
    close(']');
  }
  template <class Range, class F>
  void list(std::string_view name, const Range& all, const F& f) {
    key(name);
    list(all, f);
  }
  /// As it is: ASCII without quotes, in pieces.
  template <class F>
  void quoted(std::string_view name, const F& f) {
    key(name);
    put("\"");
    f(out_);
    out_ << '"';
  }

 private:
  void separate();
  void put(std::string_view text);
  void key(std::string_view name);
  void open(char bracket);
  void close(char bracket);

  std::ostream& out_;
  bool first_ = true;
};

}  // namespace dalembert
