#include "study/results/worker_processes.h"

#include <cstdio>
#include <exception>
#include <stdexcept>

#include <sys/wait.h>
#include <unistd.h>

namespace towbench::study {
namespace {

[[noreturn]] void work_on(const std::function<void(std::size_t)>& job, std::size_t number) {
  int code = 0;
  try {
    job(number);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    code = 1;
  }
  _exit(code);
}

}  // namespace

void run_in_processes(std::size_t jobs, const WorkerProcesses& with,
                      const std::function<void(std::size_t)>& job) {
  std::size_t busy = 0;
  std::size_t ended = 0;
  const auto wait_for_one = [&] {
    int status = 0;
    if (wait(&status) > 0) {
      --busy;
      ++ended;
    }
    if (with.progress) {
      with.progress(ended);
    }
  };
  for (std::size_t number = 0; number < jobs; ++number) {
    if (with.stop != nullptr && with.stop->load()) {
      break;
    }
    if (busy == with.workers) {
      wait_for_one();
    }
    const pid_t child = fork();
    if (child < 0) {
      throw std::runtime_error("no process can be started");
    }
    if (child == 0) {
      work_on(job, number);
    }
    ++busy;
  }
  while (busy > 0) {
    wait_for_one();
  }
}

}  // namespace towbench::study
