#include "harness/panel/steering.h"

#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace towbench::harness {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

TEST(Steering, WhatIsNotUnderstoodIsRefusedInOneSentenceAndChangesNothing) {
  const auto session = std::make_unique<Session>("runs-that-are-never-made");
  for (const char* message :
       {"",
        "{",
        "[]",
        "1",
        "null",
        R"({"do":1})",
        R"({"do":"fly"})",
        R"({"do":"pause"})",
        R"({"do":"step"})",
        R"({"do":"step","ms":"1"})",
        R"({"do":"step","ms":1e99})",
        R"({"do":"speed","speed":-1})",
        R"({"do":"inject","fault":"moon full"})",
        R"({"do":"start"})",
        R"({"do":"start","experiment":"no-such-one","speed":1})",
        R"({"do":"start","experiment":"/etc/passwd","speed":1})",
        R"({"do":"start","experiment":"../circle.toml","speed":1})",
        R"({"do":"start","experiment":"circle"})",
        R"({"do":"start","experiment":"circle","speed":1,"lines":[[99,"x"]]})",
        R"({"do":"start","experiment":"circle","speed":1,"lines":[["a"]]})",
        R"({"do":"start","experiment":"circle","speed":1,"faults":[7]})",
        R"({"do":"start","experiment":"circle","speed":1,"faults":["encoder.y nonsense at=1s"]})",
        R"({"do":"start","experiment":"circle","speed":1,"seed":-1})",
        R"({"do":"start","experiment":"circle","speed":1,"duration_limit_s":0})"}) {
    EXPECT_THAT(steer(*session, message), Not(IsEmpty())) << message;
    EXPECT_EQ(session->state().phase, Session::Phase::kIdle) << message;
  }
  EXPECT_FALSE(std::filesystem::exists("runs-that-are-never-made"));
}

TEST(Steering, AWordThatIsTooLongIsRefused) {
  const auto session = std::make_unique<Session>("runs-that-are-never-made");
  const std::string line(5000, 'x');
  EXPECT_THAT(steer(*session, R"({"do":")" + line + R"("})"), HasSubstr("4096"));
}

}  // namespace
}  // namespace towbench::harness
