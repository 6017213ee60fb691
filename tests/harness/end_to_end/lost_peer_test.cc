// Either process killed at any moment: the other ends within a second, says why, and leaves a
// folder that is readable and clearly incomplete.
#include <chrono>
#include <optional>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/harness/end_to_end/run_support.h"

namespace towbench::harness {
namespace {

using ::testing::HasSubstr;
using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

// An hour of simulated holding: a run that is still under way when it is killed.
std::string endless_experiment() {
  auto text = contents_of("fixtures/experiments/circle.toml");
  const auto replace = [&](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  replace("duration_limit_s = 40.0", "duration_limit_s = 3600.0");
  replace("--turns 2", "--turns 1000");
  replace("timeout_s = 30.0", "timeout_s = 3600.0");
  return text;
}

class Program {
 public:
  explicit Program(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), TOWBENCH_PROGRAM);
    std::vector<char*> argv;
    for (auto& argument : arguments) {
      argv.push_back(argument.data());
    }
    argv.push_back(nullptr);
    EXPECT_EQ(posix_spawn(&id_, TOWBENCH_PROGRAM, nullptr, nullptr, argv.data(), environ), 0);
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
  ~Program() {
    if (id_ > 0) {
      kill(id_, SIGKILL);
      waitpid(id_, nullptr, 0);
    }
  }

  [[nodiscard]] pid_t id() const noexcept { return id_; }
  // The exit code when it ends in time; 128 + signal when one ended it.
  std::optional<int> wait(milliseconds patience) {
    for (const auto deadline = Clock::now() + patience; Clock::now() < deadline;) {
      int status = 0;
      if (waitpid(id_, &status, WNOHANG) == id_) {
        id_ = -1;
        return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
      }
      std::this_thread::sleep_for(milliseconds(1));
    }
    return std::nullopt;
  }

 private:
  pid_t id_ = -1;
};

// The emulator that a run has started: its child.
pid_t child_of(pid_t parent) {
  const auto path =
      "/proc/" + std::to_string(parent) + "/task/" + std::to_string(parent) + "/children";
  for (const auto deadline = Clock::now() + milliseconds(5000); Clock::now() < deadline;) {
    std::istringstream children(contents_of(path));
    pid_t child = 0;
    if (children >> child) {
      return child;
    }
    std::this_thread::sleep_for(milliseconds(1));
  }
  return 0;
}

bool is_alive(pid_t id) {
  // A zombie that nobody has waited for yet has ended.
  const auto stat = contents_of("/proc/" + std::to_string(id) + "/stat");
  const auto name_end = stat.rfind(')');
  return name_end != std::string::npos && name_end + 2 < stat.size() && stat[name_end + 2] != 'Z';
}

class LostPeer : public ::testing::TestWithParam<int> {
 protected:
  LostPeer() {
    for (const char* kind : {"plants", "rigs", "controllers"}) {
      std::filesystem::copy(std::filesystem::path("fixtures") / kind, files_.folder() / kind);
    }
    experiment_ = files_.write("experiments/endless.toml", endless_experiment());
  }

  [[nodiscard]] std::vector<std::string> arguments() const {
    return {"run",         experiment_.string(),
            "--carrier",   "local",
            "--no-report", "-q",
            "--out",       (files_.folder() / "runs").string()};
  }
  void wait_until_under_way() const {
    for (const auto deadline = Clock::now() + milliseconds(5000); Clock::now() < deadline;) {
      if (const auto path = folder() / "log.csv";
          std::filesystem::exists(path) && std::filesystem::file_size(path) > 100'000) {
        break;
      }
      std::this_thread::sleep_for(milliseconds(1));
    }
    std::this_thread::sleep_for(milliseconds(GetParam()));
  }
  [[nodiscard]] std::filesystem::path folder() const {
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(files_.folder() / "runs", error)) {
      return entry.path();
    }
    return files_.folder() / "none";
  }

  TemporaryFixtures files_;
  std::filesystem::path experiment_;
};

TEST_P(LostPeer, AKilledEmulatorEndsTheRunIncomplete) {
  Program run(arguments());
  const pid_t emulator = child_of(run.id());
  ASSERT_GT(emulator, 0);
  wait_until_under_way();
  ASSERT_EQ(kill(emulator, SIGKILL), 0);
  const auto code = run.wait(milliseconds(1000));
  ASSERT_TRUE(code.has_value()) << "still running after a second";
  EXPECT_EQ(*code, kExitRuntime);
  const auto result = json_of(folder() / "result.json");
  EXPECT_EQ(result.at("status"), "incomplete");
  EXPECT_FALSE(result.contains("verdict"));
  EXPECT_THAT(result.at("reason").get<std::string>(), HasSubstr("emulator"));
  // The controller knew and said so.
  EXPECT_THAT(contents_of(folder() / "controller_events.jsonl"),
              HasSubstr(R"("kind":"fault_latched","axis":"y","code":320)"));
  EXPECT_GT(CsvTable::load(folder() / "log.csv").rows(), 100U);
}

TEST_P(LostPeer, AKilledRunEndsTheEmulatorWithItsDriveRemoved) {
  Program run(arguments());
  const pid_t emulator = child_of(run.id());
  ASSERT_GT(emulator, 0);
  wait_until_under_way();
  ASSERT_EQ(kill(run.id(), SIGKILL), 0);
  for (const auto deadline = Clock::now() + milliseconds(1000);
       is_alive(emulator) && Clock::now() < deadline;) {
    std::this_thread::sleep_for(milliseconds(1));
  }
  EXPECT_FALSE(is_alive(emulator));
  EXPECT_EQ(json_of(folder() / "result.json").at("status"), "incomplete");
  const auto events = contents_of(folder() / "plant_events.jsonl");
  EXPECT_THAT(events, HasSubstr("peer_lost"));
  EXPECT_THAT(events, HasSubstr("drive_removed"));
  EXPECT_GT(CsvTable::load(folder() / "truth.csv").rows(), 100U);
}

TEST_P(LostPeer, AnInterruptedRunEndsOrderlyAndIncomplete) {
  Program run(arguments());
  ASSERT_GT(child_of(run.id()), 0);
  wait_until_under_way();
  ASSERT_EQ(kill(run.id(), SIGINT), 0);
  const auto code = run.wait(milliseconds(1000));
  ASSERT_TRUE(code.has_value()) << "still running after a second";
  EXPECT_EQ(*code, kExitRuntime);
  const auto result = json_of(folder() / "result.json");
  EXPECT_EQ(result.at("status"), "incomplete");
  EXPECT_EQ(result.at("reason"), "interrupted");
  EXPECT_THAT(contents_of(folder() / "plant_events.jsonl"), HasSubstr("finished"));
}

// Milliseconds after the first records: several moments.
INSTANTIATE_TEST_SUITE_P(Moments, LostPeer, ::testing::Values(0, 17, 60));

}  // namespace
}  // namespace towbench::harness
