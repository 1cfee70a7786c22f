#pragma once

#include <compare>
#include <cstddef>
#include <utility>
#include <vector>

namespace dalembert {

/// The outcome of every comparison in the equations of a scene: what a user writes with abs, max, floor or
/// `if (x > 0)` has a kink or a jump where one of its comparisons changes its outcome, and nowhere else. So a
/// discontinuity is found where it is stated, however small it is and wherever within a step it falls.
///
/// A comparison of a with b hands out a - b, a function of the motion that is 0 where the equation switches,
/// and the side of 0 that the equation was evaluated on. Evaluated again on the sides that were recorded
/// before the equation is smooth, also beyond its switches: so a step goes by one smooth piece, up to where
/// that ends.
///
/// Duals report their comparisons to the listener of this thread, if there is one. (A scalar type of its own
/// would need no such thing, but would compile every equation once more.)
class Branches {
 public:
  struct Comparison {
    double difference;  ///< a - b, or how far within its piece the argument of a function with jumps is
    int side;           ///< of 0, on which the equation was evaluated
    double piece;       ///< that was taken of a function with jumps
  };
  /// Of each batch, in the order in which it makes them.
  using Sides = std::vector<std::vector<Comparison>>;

  /// Notes in `recorded` what is compared, and evaluates on the sides of `held`; each unless it is null. If
  /// both are nobody listens, not even an outer one, as long as it lives.
  Branches(Sides* recorded, const Sides* held)
      : recorded_(recorded),
        held_(held),
        outer_(std::exchange(listening, recorded == nullptr && held == nullptr ? nullptr : this)) {}
  Branches(const Branches&) = delete;
  Branches& operator=(const Branches&) = delete;
  ~Branches() { listening = outer_; }

  /// What is compared from here on belongs to this batch, which begins anew.
  static void enter_batch(std::size_t number) {
    if (listening != nullptr) listening->begin(number);
  }
  [[nodiscard]] static bool recording() { return listening != nullptr; }
  /// Where its next comparison stands among those of its batch.
  [[nodiscard]] static std::size_t next() { return listening == nullptr ? 0 : listening->next_; }
  /// Comparisons from that place on are made once more, as an equation is evaluated again at the same state.
  static void again(std::size_t from) {
    if (listening != nullptr) listening->go_back(from);
  }
  /// Whether comparisons of plain numbers, which nobody hears, would make a difference.
  [[nodiscard]] static bool needed() {
    return listening != nullptr && (listening->held_ == nullptr || listening->own() != nullptr);
  }
  [[nodiscard]] static std::partial_ordering compare(double a, double b) {
    return listening == nullptr ? a <=> b : listening->add(a, b);
  }
  /// The piece of a function with jumps, of which `natural` is that of its argument.
  [[nodiscard]] static double choose(double natural) {
    return listening == nullptr ? natural : listening->add_piece(natural);
  }
  /// How far the argument is from where that piece ends.
  static void within(double distance) {
    if (listening != nullptr) (void)listening->note({distance, 1, 0.0});
  }
  /// Calls f. Where that fails, as a root beyond the end of its piece may, calls it on the sides where its
  /// arguments are.
  template <class Fault, class F>
  static void or_naturally(const F& f) {
    if (listening == nullptr || listening->held_ == nullptr) return f();
    const std::size_t next = listening->next_;
    try {
      f();
    } catch (const Fault&) {
      listening->go_back(next);
      listening->strayed_ = true;
      const Natural natural(*listening);
      f();
    }
  }
  /// Whether that has happened since it was last asked.
  [[nodiscard]] static bool strayed() {
    return listening != nullptr && std::exchange(listening->strayed_, false);
  }

 private:
  /// As long as it lives nothing is held.
  struct Natural {
    Branches& own;
    const Sides* held;
    explicit Natural(Branches& listener) : own(listener), held(std::exchange(listener.held_, nullptr)) {}
    Natural(const Natural&) = delete;
    Natural& operator=(const Natural&) = delete;
    ~Natural() { own.held_ = held; }
  };
  void begin(std::size_t number) {
    batch_ = number;
    next_ = 0;
    if (recorded_ == nullptr) return;
    if (recorded_->size() <= number) recorded_->resize(number + 1);
    (*recorded_)[number].clear();
  }
  void go_back(std::size_t next) {
    next_ = next;
    if (recorded_ == nullptr || batch_ >= recorded_->size()) return;
    auto& recorded = (*recorded_)[batch_];
    if (next < recorded.size())
      recorded.erase(recorded.begin() + static_cast<std::ptrdiff_t>(next), recorded.end());
  }
  [[nodiscard]] const Comparison* own() const {
    if (held_ == nullptr || batch_ >= held_->size() || next_ >= (*held_)[batch_].size()) return nullptr;
    return &(*held_)[batch_][next_];
  }
  [[gnu::noinline]] Comparison note(Comparison natural) {
    if (const Comparison* const other = own()) {
      natural.side = other->side;
      natural.piece = other->piece;
    }
    ++next_;
    if (recorded_ != nullptr && batch_ < recorded_->size()) (*recorded_)[batch_].push_back(natural);
    return natural;
  }
  // Not inlined: each comparison in an equation would be compiled with a vector that grows.
  [[gnu::noinline]] std::partial_ordering add(double a, double b) {
    const std::partial_ordering natural = a <=> b;
    const bool held = own() != nullptr;
    const Comparison its = note({a - b, natural < 0 ? -1 : natural == 0 ? 0 : 1, 0.0});
    return held ? std::partial_ordering(its.side <=> 0) : natural;
  }
  [[gnu::noinline]] double add_piece(double natural) { return note({1.0, 1, natural}).piece; }

  static inline thread_local constinit Branches* listening = nullptr;
  Sides* recorded_;
  const Sides* held_;
  Branches* outer_;
  std::size_t batch_ = 0, next_ = 0;
  bool strayed_ = false;
};

}  // namespace dalembert
