#include "tests/support/allocation_guard.h"

#include <cstdio>
#include <cstdlib>
#include <new>

namespace towbench::tests {
namespace {

thread_local int guards = 0;
thread_local std::size_t count = 0;

}  // namespace

AllocationGuard::AllocationGuard() noexcept {
  ++guards;
}
AllocationGuard::~AllocationGuard() {
  --guards;
}
std::size_t AllocationGuard::allocations() noexcept {
  return count;
}

// Shared by every form below; not in the header, and named so that a stack trace explains itself.
void note_heap_use() noexcept {
  ++count;
  if (guards > 0) {
    guards = 0;  // the report itself may allocate
    std::fputs("heap used inside an AllocationGuard\n", stderr);
    std::abort();
  }
}

namespace {

void* allocate(std::size_t size, std::size_t alignment) {
  note_heap_use();
  const std::size_t rounded = (size + alignment - 1) / alignment * alignment;
  void* memory = alignment <= alignof(std::max_align_t)
                     ? std::malloc(size == 0 ? 1 : size)
                     : std::aligned_alloc(alignment, rounded == 0 ? alignment : rounded);
  if (memory == nullptr) {
    throw std::bad_alloc();
  }
  return memory;
}

void release(void* memory) noexcept {
  if (memory != nullptr) {
    note_heap_use();
    std::free(memory);
  }
}

}  // namespace
}  // namespace towbench::tests

void* operator new(std::size_t size) {
  return towbench::tests::allocate(size, alignof(std::max_align_t));
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return towbench::tests::allocate(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept {
  towbench::tests::release(memory);
}
void operator delete(void* memory, std::size_t /*size*/) noexcept {
  towbench::tests::release(memory);
}
void operator delete(void* memory, std::align_val_t /*alignment*/) noexcept {
  towbench::tests::release(memory);
}
void operator delete(void* memory, std::size_t /*size*/, std::align_val_t /*alignment*/) noexcept {
  towbench::tests::release(memory);
}
