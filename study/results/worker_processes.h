// Jobs in processes of their own, so many at once: one that crashes takes no other with it.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>

namespace towbench::study {

struct WorkerProcesses {
  std::size_t workers = 1;
  const std::atomic<bool>* stop = nullptr;  // once true, nothing more is started
  std::function<void(std::size_t ended)> progress{};
};

// Runs job(0) .. job(jobs - 1) and waits for all that were started. What a job throws goes to
// standard error. Throws std::runtime_error when no process can be started.
void run_in_processes(std::size_t jobs, const WorkerProcesses& with,
                      const std::function<void(std::size_t)>& job);

}  // namespace towbench::study
