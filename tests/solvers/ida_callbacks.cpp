#include <dalembert/solvers/ida/ida_solver.h>

#include <gtest/gtest.h>

#include <new>

namespace dalembert::ida_callbacks_test {
namespace {

/// What `guarded` needs of the stepper.
struct Memory {
  std::string fault;
  std::exception_ptr thrown;
  void blame(double /*at*/, const std::string& what) { fault = what; }
};

TEST(IdaCallbacks, AFaultOfAnEquationIsRecoverable) {
  Memory memory;
  EXPECT_EQ(guarded(memory, 0.0, []() -> int { throw EquationFault("bad"); }), 1);
  EXPECT_EQ(memory.fault, "bad");
  EXPECT_FALSE(memory.thrown);
}

TEST(IdaCallbacks, AnyOtherExceptionIsKeptForTheCaller) {
  Memory memory;
  EXPECT_EQ(guarded(memory, 0.0, []() -> int { throw std::bad_alloc(); }), -1);
  EXPECT_THROW(std::rethrow_exception(memory.thrown), std::bad_alloc);
}

}  // namespace
}  // namespace dalembert::ida_callbacks_test
