// Who observes gives way, and what an observer starts does not but goes ahead where it may.
#include "harness/panel/turns.h"

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/resource.h>

#include "harness/panel/session.h"
#include "tests/harness/fixtures/temporary_fixtures.h"

namespace towbench::harness {
namespace {

int policy_of(const std::filesystem::path& task) {
  return ::sched_getscheduler(std::stoi(task.filename().string()));
}

// How many threads of this process there are of each policy.
std::map<int, int> threads_by_policy() {
  std::map<int, int> count;
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
    ++count[policy_of(task.path())];
  }
  return count;
}

TEST(Turns, ARunThatALookerOnStartsTakesItsTurns) {
  const TemporaryFixtures folder;
  const auto session = std::make_unique<Session>(folder.folder());
  const auto before = threads_by_policy();
  observe_only();
  session->start({.experiment = "circle", .pace = {.speed = 0, .paused = true}});
  while (session->tap().folder().empty()) {
    std::this_thread::yield();  // it has begun once it has told where it writes
  }
  auto during = threads_by_policy();
  share_processor();
  EXPECT_EQ(during[SCHED_BATCH], 1) << "this thread alone gives way";
  EXPECT_GE(during[SCHED_OTHER], before.at(SCHED_OTHER)) << "the run's does not";
  EXPECT_EQ(::sched_getscheduler(0), SCHED_OTHER);
}

TEST(Turns, WhoWorksGoesAheadWhereTheHostAllowsItAndNotWhenItObservesAgain) {
  std::thread([] {
    observe_only();
    const int own = ::getpriority(PRIO_PROCESS, 0);
    share_processor();
    const int ahead = ::getpriority(PRIO_PROCESS, 0);
    const bool allowed = ::setpriority(PRIO_PROCESS, 0, own - 1) == 0;
    share_processor();
    EXPECT_EQ(ahead, allowed ? -10 : own);
    observe_only();
    EXPECT_EQ(::getpriority(PRIO_PROCESS, 0), own);
  }).join();
}

}  // namespace
}  // namespace towbench::harness
