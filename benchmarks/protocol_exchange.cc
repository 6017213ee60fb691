// What one exchange between two processes costs by itself, without the bench's code: 64 bytes there
// and 32 back over a local socket, blocking and without, and a word in shared memory. It bounds how
// fast a controller in a process of its own can be run. Rounds in alternation, median.
// usage: benchmark_protocol_exchange [ROUNDS]; on one core: taskset -c 0
// benchmark_protocol_exchange
#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <vector>

#include <sched.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

namespace {

constexpr int kTurns = 20000;
constexpr int kRounds = 7;

struct Socket {
  int end;
  int flags;  // MSG_DONTWAIT: gives way to the peer until something has come

  [[nodiscard]] bool send(std::size_t bytes) const {
    return ::send(end, kMessage.data(), bytes, MSG_NOSIGNAL) == static_cast<ssize_t>(bytes);
  }
  [[nodiscard]] bool receive() const {
    std::array<char, 64> into{};
    for (;;) {
      const ssize_t got = recv(end, into.data(), into.size(), flags);
      if (got > 0) return true;
      if (got == 0 || errno != EAGAIN) return false;
      sched_yield();
    }
  }
  static constexpr std::array<char, 64> kMessage{};
};

double seconds_of(const auto& turn) {
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < kTurns; ++i) {
    if (!turn(i)) std::exit(1);
  }
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double over_socket(int flags) {
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()) != 0) std::exit(1);
  const pid_t peer = fork();
  if (peer == 0) {
    close(ends[0]);
    const Socket socket{ends[1], flags};
    while (socket.receive() && socket.send(32)) {
    }
    _exit(0);
  }
  close(ends[1]);
  const Socket socket{ends[0], flags};
  const double took = seconds_of([&](int) { return socket.send(64) && socket.receive(); });
  close(ends[0]);
  waitpid(peer, nullptr, 0);
  return took;
}

double over_memory() {
  void* page = mmap(nullptr, 4096, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (page == MAP_FAILED) std::exit(1);
  auto& word = *new (page) std::atomic<int>(0);  // odd: a request, even: answered
  const auto wait_for = [&](int value) {
    while (word.load(std::memory_order_acquire) != value) sched_yield();
  };
  const pid_t peer = fork();
  if (peer == 0) {
    for (int i = 0; i < kTurns; ++i) {
      wait_for(2 * i + 1);
      word.store(2 * i + 2, std::memory_order_release);
    }
    _exit(0);
  }
  const double took = seconds_of([&](int i) {
    word.store(2 * i + 1, std::memory_order_release);
    wait_for(2 * i + 2);
    return true;
  });
  waitpid(peer, nullptr, 0);
  munmap(page, 4096);
  return took;
}

void print(const char* what, std::vector<double>& rounds) {
  std::sort(rounds.begin(), rounds.end());
  const auto us = [](double seconds) { return 1e6 * seconds / kTurns; };
  std::printf("%-24s %6.2f us (%.2f to %.2f)\n", what, us(rounds[rounds.size() / 2]),
              us(rounds.front()), us(rounds.back()));
}

}  // namespace

int main() {
  std::vector<double> blocking;
  std::vector<double> yielding;
  std::vector<double> memory;
  for (int i = 0; i < kRounds; ++i) {
    blocking.push_back(over_socket(0));
    yielding.push_back(over_socket(MSG_DONTWAIT));
    memory.push_back(over_memory());
  }
  print("socket, blocking", blocking);
  print("socket, giving way", yielding);
  print("shared memory", memory);
}
