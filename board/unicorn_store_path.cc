// Unicorn 2.0 sends every store to RAM the slow way, as one that might hit translated code, and
// takes the locks of the pages concerned: four heap allocations and a tree per store, in an engine
// that has one thread. The library calls its own functions through its symbol table, so that a
// program may put others in their place:
//
//   page_collection_lock, _unlock   do nothing: there is nobody to lock out
//   tb_invalidate_phys_page_fast    does what it did, and then lets later stores to a page without
//                                   code go the fast way (the library's own tlb_set_dirty)
//   cpu_exec                        tells which CPU that is
//
// A page in which code turns up later is watched again from then on. Any other version of Unicorn
// gets its own functions back.
#include "board/unicorn_store_path.h"

#include <dlfcn.h>
#include <unicorn/unicorn.h>

namespace towbench::board {
namespace {

using Execute = int (*)(void* engine, void* cpu);
using Lock = void* (*)(void* engine, std::uint64_t start, std::uint64_t end);
using Unlock = void (*)(void* pages);
using Invalidate = void (*)(void* engine, void* pages, std::uint64_t start, int size,
                            std::uintptr_t from);
using SetDirty = void (*)(void* cpu, std::uint32_t address);
using Flush = void (*)(void* cpu);

bool is_known_version() noexcept {
  unsigned major = 0;
  unsigned minor = 0;
  static_cast<void>(uc_version(&major, &minor));
  return major == 2 && minor == 0;
}

template <typename Function>
Function original(const char* name) noexcept {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

const bool kFast = is_known_version();
thread_local StorePath* active = nullptr;

}  // namespace

void StorePath::begin() noexcept {
  active = this;
}

void StorePath::end() noexcept {
  if (active == this) {
    active = nullptr;
  }
}

void StorePath::code_at(std::uint32_t address, std::uint32_t size) {
  bool was_free = false;
  for (std::uint64_t page = (address - address_) / kPage;
       page < is_code_.size() && page * kPage < std::uint64_t{address} - address_ + size; ++page) {
    const auto at = static_cast<std::size_t>(page);
    was_free = was_free || is_free_[at];
    is_code_[at] = true;
    is_free_[at] = false;
  }
  if (was_free && cpu_ != nullptr) {
    static const auto flush = original<Flush>("tlb_flush_arm");
    if (flush != nullptr) {
      flush(cpu_);
    }
  }
}

bool StorePath::may_free(std::uint64_t offset) noexcept {
  const auto page = static_cast<std::size_t>(offset / kPage);
  if (page >= is_code_.size() || is_code_[page]) {
    return false;
  }
  is_free_[page] = true;
  return true;
}

}  // namespace towbench::board

using towbench::board::active;
using towbench::board::kFast;
using towbench::board::original;

// The library's names and types.
extern "C" {

int cpu_exec_arm(void* engine, void* cpu) {
  static const auto execute = original<towbench::board::Execute>("cpu_exec_arm");
  if (active != nullptr) {
    active->attach(cpu);
  }
  return execute(engine, cpu);
}

void* page_collection_lock_arm(void* engine, std::uint64_t start, std::uint64_t end) {
  static const auto lock = original<towbench::board::Lock>("page_collection_lock_arm");
  return kFast ? nullptr : lock(engine, start, end);
}

void page_collection_unlock_arm(void* pages) {
  static const auto unlock = original<towbench::board::Unlock>("page_collection_unlock_arm");
  if (!kFast) {
    unlock(pages);
  }
}

void tb_invalidate_phys_page_fast_arm(void* engine, void* pages, std::uint64_t start, int size,
                                      std::uintptr_t from) {
  static const auto invalidate =
      original<towbench::board::Invalidate>("tb_invalidate_phys_page_fast_arm");
  static const auto set_dirty = original<towbench::board::SetDirty>("tlb_set_dirty_arm");
  invalidate(engine, pages, start, size, from);
  if (kFast && active != nullptr && active->cpu() != nullptr && set_dirty != nullptr &&
      active->may_free(start)) {
    set_dirty(active->cpu(), active->address() + static_cast<std::uint32_t>(start));
  }
}

}  // extern "C"
