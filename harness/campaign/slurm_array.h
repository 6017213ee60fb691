// A campaign as one Slurm job array: each task is a shard, all write into the same folder, which
// every node must see. Slurm schedules; this writes the job, submits it and waits.
#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace towbench::harness {

struct SlurmArray {
  std::string name;                     // of the job
  std::size_t tasks = 1;                // shards
  std::filesystem::path program;        // seen by every node
  std::vector<std::string> arguments;   // of the program, without shard and folder
  std::filesystem::path folder;         // of the results
  std::vector<std::string> directives;  // more #SBATCH lines: "--partition=main"
};

// The job's text, for bash.
[[nodiscard]] std::string job_script(const SlurmArray& array);

// Writes folder/slurm/job.sh, submits the shards named (1 .. tasks) and waits until Slurm has done
// with them, however they ended; what they did is in their results. Returns the job's number; none
// when `stop` was set, and then the job is cancelled. Throws std::runtime_error when Slurm does not
// take the job.
[[nodiscard]] std::string submit_and_wait(const SlurmArray& array,
                                          const std::vector<std::size_t>& shards,
                                          const std::atomic<bool>& stop);

}  // namespace towbench::harness
