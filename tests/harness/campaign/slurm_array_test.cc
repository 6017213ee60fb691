// What is handed to Slurm; the real thing is tests/slurm/slurm_test.sh.
#include "harness/campaign/slurm_array.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace towbench::harness {
namespace {

using ::testing::HasSubstr;

TEST(SlurmArray, ATaskIsOneShardOfTheCampaign) {
  const auto text = job_script({.name = "standard",
                                .tasks = 40,
                                .program = "/opt/bench",
                                .arguments = {"campaign", "standard.toml", "--seeds", "3"},
                                .folder = "/data/it's here",
                                .directives = {"--partition=main"}});
  EXPECT_THAT(text, ::testing::StartsWith("#!/bin/bash\n"));
  EXPECT_THAT(text, HasSubstr("#SBATCH --partition=main\n"));
  EXPECT_THAT(text, HasSubstr("'/opt/bench' 'campaign' 'standard.toml' '--seeds' '3'"));
  EXPECT_THAT(text, HasSubstr("--shard \"$SLURM_ARRAY_TASK_ID/40\""));
  EXPECT_THAT(text, HasSubstr("--out '/data/it'\\''s here'"));
}

}  // namespace
}  // namespace towbench::harness
