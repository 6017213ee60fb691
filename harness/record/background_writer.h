// A thread that does the formatting and the system calls of a record, so that the bench's own
// thread only copies rows. Jobs run in the order given; nothing is dropped: when too many wait, the
// giver waits.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace towbench::harness {

class BackgroundWriter {
 public:
  BackgroundWriter() : thread_([this] { work(); }) {}
  BackgroundWriter(const BackgroundWriter&) = delete;
  BackgroundWriter& operator=(const BackgroundWriter&) = delete;
  // Finishes every job first.
  ~BackgroundWriter();

  void post(std::function<void()> job);
  // Returns when every job given so far is done; what the jobs wrote is then visible to the caller.
  void wait();

 private:
  void work();

  static constexpr std::size_t kMostWaiting = 16;

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> jobs_;
  bool busy_ = false;
  bool ending_ = false;
  std::thread thread_;  // last: starts when all else exists
};

}  // namespace towbench::harness
