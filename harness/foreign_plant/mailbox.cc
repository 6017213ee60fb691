#include "harness/foreign_plant/mailbox.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <ctime>
#include <new>
#include <system_error>

#include <linux/futex.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace towbench::harness {
namespace {

using HostClock = std::chrono::steady_clock;

constexpr int kMostLooks = 4000;  // some 80 us: a sleeping processor wakes in 50
constexpr int kFewestLooks = 4;
constexpr unsigned kWaitsBetween = 256;

void relax() noexcept {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#endif
}

long futex(std::atomic<std::uint32_t>& word, int operation, std::uint32_t value,
           const timespec* longest) noexcept {
  // NOLINTNEXTLINE: the system call's own way
  return syscall(SYS_futex, reinterpret_cast<std::uint32_t*>(&word), operation, value, longest,
                 nullptr, 0);
}

}  // namespace

void TurnWord::post(std::uint32_t value) noexcept {
  word_.store(value, std::memory_order_seq_cst);
  if (sleeps_.load(std::memory_order_seq_cst) != 0) {
    (void)futex(word_, FUTEX_WAKE, 1, nullptr);
  }
}

bool TurnWord::changes_from(std::uint32_t old, std::int64_t longest_ns) noexcept {
  // Now and then as many as at best: the host may have become idle again.
  const int looks = ++waits_ % kWaitsBetween == 0 ? kMostLooks : looks_;
  for (int i = 0; i < looks; ++i) {
    if (value() != old) {
      looks_ = std::min(2 * looks + kFewestLooks, kMostLooks);
      return true;
    }
    relax();
  }
  looks_ = std::max(looks_ / 2, kFewestLooks);
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  const bool for_ever = longest_ns < 0;
  const auto deadline = HostClock::now() + std::chrono::nanoseconds(for_ever ? 0 : longest_ns);
  sleeps_.store(1, std::memory_order_seq_cst);
  while (word_.load(std::memory_order_seq_cst) == old) {
    const auto left_ns =
        for_ever ? kSecond_ns : std::chrono::nanoseconds(deadline - HostClock::now()).count();
    if (left_ns <= 0) {
      break;
    }
    const timespec longest{.tv_sec = left_ns / kSecond_ns, .tv_nsec = left_ns % kSecond_ns};
    (void)futex(word_, FUTEX_WAIT, old, &longest);
  }
  sleeps_.store(0, std::memory_order_seq_cst);
  return value() != old;
}

void UnmapMailbox::operator()(Mailbox* mailbox) const noexcept {
  (void)munmap(mailbox, sizeof(Mailbox));
}

SharedMailbox make_mailbox() {
  void* const memory =
      mmap(nullptr, sizeof(Mailbox), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) {
    throw std::system_error(errno, std::generic_category(), "mmap");
  }
  return SharedMailbox(new (memory) Mailbox);
}

}  // namespace towbench::harness
