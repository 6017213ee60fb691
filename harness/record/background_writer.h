// A thread that does the formatting and the system calls of a record, so that the bench's own
// thread only copies rows. Jobs run in the order given; nothing is dropped: when too many wait, the
// giver waits.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <thread>

#include "core/realtime.h"
#include "core/spsc_queue.h"

namespace towbench::harness {

// Memory of the giver's that the writer reads. It outlives the writer's work on it.
class WriterJob {
 public:
  WriterJob() = default;
  WriterJob(const WriterJob&) = delete;
  WriterJob& operator=(const WriterJob&) = delete;
  virtual ~WriterJob() = default;
  // On the writer's thread.
  virtual void run() noexcept = 0;

 private:
  friend class BackgroundWriter;
  std::atomic<bool> is_given_ = false;  // until it has run
};

// One thread gives and waits.
class BackgroundWriter {
 public:
  BackgroundWriter() : thread_([this] { work(); }) {}
  BackgroundWriter(const BackgroundWriter&) = delete;
  BackgroundWriter& operator=(const BackgroundWriter&) = delete;
  // Finishes every job first.
  ~BackgroundWriter();

  // Wakes nobody: the writer looks by itself every kLook. Waits only while kMostWaiting wait.
  TOWBENCH_REALTIME void give(WriterJob& job) noexcept;
  [[nodiscard]] TOWBENCH_REALTIME bool is_given(const WriterJob& job) const noexcept {
    return job.is_given_.load(std::memory_order_acquire);
  }
  // Returns when the job is done, or every job given so far; what was written is then visible to
  // the caller.
  void wait_for(const WriterJob& job);
  void wait();

 private:
  template <typename Condition>
  void wait_until(Condition condition);
  void run_all() noexcept;
  void work();

  static constexpr std::size_t kMostWaiting = 64;
  static constexpr std::chrono::milliseconds kLook{10};

  core::SpscQueue<WriterJob*, kMostWaiting> jobs_;
  std::size_t given_ = 0;              // giver's
  std::atomic<std::size_t> done_ = 0;  // jobs
  std::atomic<bool> is_awaited_ = false;

  std::mutex mutex_;
  std::condition_variable look_;
  std::condition_variable progress_;
  bool ending_ = false;
  std::thread thread_;  // last: starts when all else exists
};

}  // namespace towbench::harness
