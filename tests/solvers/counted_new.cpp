#include "counted_new.h"

#include <cstdlib>
#include <new>

// In a file of their own: inlined beside their callers, g++ 12 takes malloc and delete for a mismatch.
namespace {
long count = 0, lacking_at = -1;

bool lacking() { return ++count == lacking_at; }
}  // namespace

void* operator new(std::size_t size) {
  if (void* p = lacking() ? nullptr : std::malloc(size)) return p;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return lacking() ? nullptr : std::malloc(size);
}
void operator delete(void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }

namespace dalembert {

long allocations() { return count; }

LackOfMemory::LackOfMemory(long after) { lacking_at = count + after + 1; }
LackOfMemory::~LackOfMemory() { lacking_at = -1; }
bool LackOfMemory::came() const { return count >= lacking_at; }

}  // namespace dalembert
