#include "counted_new.h"

#include <cstdlib>
#include <new>

// In a file of their own: inlined beside their callers, g++ 12 takes malloc and delete for a mismatch.
namespace {
long count = 0;
}

void* operator new(std::size_t size) {
  ++count;
  if (void* p = std::malloc(size)) return p;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++count;
  return std::malloc(size);
}
void operator delete(void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }

namespace dalembert {

long allocations() { return count; }

}  // namespace dalembert
