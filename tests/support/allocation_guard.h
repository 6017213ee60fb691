// Fails a test in which code that must not allocate does.
//
//   {
//     const AllocationGuard guard;
//     plant.step(...);            // any operator new or delete on this thread aborts here, where
//   }                             // the stack shows who did it
//
// Link with test_support: it replaces the global operator new and delete of the test program.
#pragma once

#include <cstddef>

namespace towbench::tests {

class AllocationGuard {
 public:
  AllocationGuard() noexcept;
  ~AllocationGuard();
  AllocationGuard(const AllocationGuard&) = delete;
  AllocationGuard& operator=(const AllocationGuard&) = delete;

  // Allocations of this thread so far, guarded or not: proves that the guard is wired in.
  [[nodiscard]] static std::size_t allocations() noexcept;
};

}  // namespace towbench::tests
