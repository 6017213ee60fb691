#include "harness/record/background_writer.h"

#include <pthread.h>
#include <sched.h>

namespace towbench::harness {
namespace {

// A thread inherits from the one that makes it. Formatting at a loop's own priority on its own
// processor would hold that loop up for as long as a block of rows takes.
void be_ordinary() noexcept {
  const sched_param ordinary{};
  (void)pthread_setschedparam(pthread_self(), SCHED_OTHER, &ordinary);
  cpu_set_t all;
  CPU_ZERO(&all);
  for (std::size_t cpu = 0; cpu < CPU_SETSIZE; ++cpu) {
    CPU_SET(cpu, &all);
  }
  (void)pthread_setaffinity_np(pthread_self(), sizeof(all), &all);  // of these, what is allowed
}

}  // namespace

BackgroundWriter::~BackgroundWriter() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  look_.notify_one();
  thread_.join();
}

void BackgroundWriter::give(WriterJob& job) noexcept {
  job.is_given_.store(true, std::memory_order_relaxed);
  while (!jobs_.push(&job)) {
    wait();
  }
  ++given_;
}

void BackgroundWriter::wait_for(const WriterJob& job) {
  wait_until([&] { return !is_given(job); });
}

void BackgroundWriter::wait() {
  wait_until([this] { return done_.load(std::memory_order_acquire) == given_; });
}

template <typename Condition>
void BackgroundWriter::wait_until(Condition condition) {
  std::unique_lock lock(mutex_);
  is_awaited_ = true;
  look_.notify_one();
  progress_.wait(lock, condition);
  is_awaited_ = false;
}

void BackgroundWriter::run_all() noexcept {
  WriterJob* job = nullptr;
  while (jobs_.pop(job)) {
    job->run();
    job->is_given_.store(false, std::memory_order_release);
    done_.fetch_add(1, std::memory_order_release);
    if (is_awaited_) {
      const std::lock_guard lock(mutex_);
      progress_.notify_one();
    }
  }
}

void BackgroundWriter::work() {
  be_ordinary();
  std::unique_lock lock(mutex_);
  while (!ending_ || !jobs_.empty()) {
    lock.unlock();
    run_all();
    lock.lock();
    look_.wait_for(lock, kLook, [this] { return ending_ || (is_awaited_ && !jobs_.empty()); });
  }
}

}  // namespace towbench::harness
