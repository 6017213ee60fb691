#include "harness/campaign/slurm_array.h"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <fstream>
#include <stdexcept>
#include <system_error>
#include <thread>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include "harness/campaign/shell_words.h"
#include "harness/record/line_writer.h"

namespace towbench::harness {
namespace {

// A program of the path, its output in files.
pid_t start(const std::vector<std::string>& words, const std::filesystem::path& output,
            const std::filesystem::path& errors) {
  std::vector<char*> arguments;
  for (const auto& word : words) {
    arguments.push_back(const_cast<char*>(word.c_str()));  // NOLINT: execvp changes nothing
  }
  arguments.push_back(nullptr);
  const pid_t id = fork();
  if (id < 0) {
    throw std::system_error(errno, std::generic_category(), "fork");
  }
  if (id == 0) {
    constexpr mode_t kReadable = 0644;
    const int out = open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, kReadable);
    const int err = open(errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC, kReadable);
    if (out >= 0 && err >= 0 && dup2(out, STDOUT_FILENO) >= 0 && dup2(err, STDERR_FILENO) >= 0) {
      execvp(arguments[0], arguments.data());
    }
    constexpr int kNotFound = 127;
    _exit(kNotFound);
  }
  return id;
}

// False when `stop` was set first; the program is then told to end.
bool wait_for(pid_t id, const std::atomic<bool>& stop) {
  constexpr std::chrono::milliseconds kLook{50};
  while (waitpid(id, nullptr, WNOHANG) == 0) {
    if (stop.load(std::memory_order_relaxed)) {
      kill(id, SIGTERM);
      waitpid(id, nullptr, 0);
      return false;
    }
    std::this_thread::sleep_for(kLook);
  }
  return true;
}

std::string first_line(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  return line;
}

}  // namespace

std::string job_script(const SlurmArray& array) {
  auto text = fmt::format(
      "#!/bin/bash\n"
      "#SBATCH --job-name=towbench-{}\n"
      "#SBATCH --ntasks=1\n"
      "#SBATCH --cpus-per-task=1\n",
      array.name);
  for (const auto& line : array.directives) {
    text += "#SBATCH " + line + '\n';
  }
  text += "exec " + shell_quoted(array.program.string());
  for (const auto& word : array.arguments) {
    text += ' ' + shell_quoted(word);
  }
  return text +
         fmt::format(" \\\n  --shard \"$SLURM_ARRAY_TASK_ID/{}\" --workers 1 --quiet --out {}\n",
                     array.tasks, shell_quoted(array.folder.string()));
}

std::string submit_and_wait(const SlurmArray& array, const std::vector<std::size_t>& shards,
                            const std::atomic<bool>& stop) {
  const auto folder = array.folder / "slurm";
  std::filesystem::create_directories(folder);
  write_atomically(folder / "job.sh", job_script(array));
  const auto number = folder / "job-number";
  const auto errors = folder / "sbatch-errors";
  const auto id =
      start({"sbatch", "--parsable", "--wait", fmt::format("--array={}", fmt::join(shards, ",")),
             "--output=" + (folder / "task-%a.out").string(), (folder / "job.sh").string()},
            number, errors);
  const bool waited = wait_for(id, stop);
  // "12" or "12;cluster"; nothing when the job was not taken.
  const auto line = first_line(number);
  auto job = line.substr(0, line.find(';'));
  if (job.empty()) {
    throw std::runtime_error("sbatch did not take the job: " + first_line(errors));
  }
  if (!waited) {
    const std::atomic<bool> never{false};
    (void)wait_for(start({"scancel", job}, folder / "scancel", folder / "scancel-errors"), never);
    return {};
  }
  return job;
}

}  // namespace towbench::harness
