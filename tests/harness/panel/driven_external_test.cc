// A controller that the bench did not write, driven from the panel: chosen where the panel starts,
// held, killed, reset, and judged; and the same bits again.
#include <fstream>
#include <sstream>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "harness/panel/live_operator.h"
#include "harness/panel/panel_json.h"
#include "harness/panel/session.h"
#include "harness/panel/steering.h"
#include "harness/record/temporary_folder.h"

namespace towbench::harness {
namespace {

using ::testing::HasSubstr;

constexpr const char* kPid = "python3 clients/python/examples/pid.py {address}";

std::string whole_text(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

class DrivenExternal : public ::testing::Test {
 protected:
  ~DrivenExternal() override { session_.cut_short(); }

  std::string start(const std::string& name, const std::string& more = "\"speed\": 0") {
    return steer(session_,
                 R"({"do": "start", "experiment": ")" + name + "\", \"lines\": [], " + more + "}");
  }
  Session::State over() {
    while (session_.state().phase != Session::Phase::kOver) {
      std::this_thread::yield();
    }
    return session_.state();
  }
  // Lets the paused run go on to that time.
  void step_to(double time_s) {
    auto& run_operator = dynamic_cast<LiveOperator&>(session_.run_operator());
    const auto until_ns = core::nanoseconds(time_s);
    run_operator.step(until_ns - run_operator.now_ns());
    while (run_operator.now_ns() < until_ns) {
      std::this_thread::yield();
    }
  }

  TemporaryFolder out_;
  Session session_{out_.path(), ExternalController{.command = kPid}};
};

TEST_F(DrivenExternal, FollowsTheReferenceAndPasses) {
  ASSERT_EQ(start("any-controller/trapezoid-y"), "");
  const auto state = over();
  EXPECT_EQ(state.verdict, "PASS") << state.reason;
  EXPECT_THAT(whole_text(out_.path() / state.folder / "result.json"), HasSubstr("process:python3"));
  EXPECT_GT(session_.tap().rows().written(), 2000U);
}

TEST_F(DrivenExternal, IsKilledAndResetByHandJudgedAndReplayed) {
  ASSERT_EQ(start("any-controller/trapezoid-y", R"("speed": 0, "paused": true)"), "");
  step_to(1.2);
  EXPECT_THAT(steer(session_, R"({"do": "type", "text": "help\r"})"), HasSubstr("`reset`"));
  EXPECT_THAT(steer(session_, R"({"do": "inject", "fault": "host missed_ticks"})"),
              HasSubstr("a fault of the machine"));
  EXPECT_EQ(steer(session_, R"({"do": "inject", "fault": "kill_switch pressed"})"), "");
  step_to(1.4);
  EXPECT_EQ(steer(session_, R"({"do": "clear", "fault": "kill_switch pressed"})"), "");
  step_to(1.5);
  EXPECT_EQ(steer(session_, R"({"do": "type", "text": "reset\r"})"), "");
  EXPECT_EQ(steer(session_, R"({"do": "speed", "speed": 0})"), "");
  const auto state = over();
  EXPECT_EQ(state.verdict, "PASS") << state.reason;
  const auto folder = out_.path() / state.folder;
  const auto events = whole_text(folder / "events.jsonl");
  for (const char* part :
       {R"("kind":"operator_reset","axis":"y","lines":0,"value":1)",
        R"("side":"operator","kind":"cleared")", R"("side":"operator","kind":"typed")"}) {
    EXPECT_THAT(events, HasSubstr(part));
  }
  RunOptions again;
  again.out = out_.path();
  again.external = session_.controller();
  const auto replayed =
      run_experiment(load_experiment(folder / "inputs/any-controller/trapezoid-y.toml"), again);
  EXPECT_EQ(replayed.judgement.verdict, Verdict::kPass);
  for (const char* file : {"log.csv", "truth.csv", "events.jsonl"}) {
    EXPECT_EQ(whole_text(folder / file), whole_text(replayed.folder / file)) << file;
  }
}

TEST_F(DrivenExternal, FinishedBeforeItsEndItHasNotFollowed) {
  ASSERT_EQ(start("any-controller/trapezoid-y", R"("speed": 0, "paused": true)"), "");
  step_to(0.4);
  EXPECT_EQ(steer(session_, R"({"do": "finish"})"), "");
  const auto state = over();
  EXPECT_NE(state.verdict, "PASS");
  EXPECT_THAT(state.reason, HasSubstr("finished by hand"));
}

TEST(PanelWithoutController, RefusesAReferenceInWordsAndOffersNone) {
  const TemporaryFolder out;
  Session session(out.path());
  EXPECT_THAT(steer(session, R"({"do": "start", "experiment": "any-controller/circle",
                                 "lines": [], "speed": 0})"),
              HasSubstr("--controller process:COMMAND"));
  EXPECT_EQ(catalogue_json().find("any-controller/"), std::string::npos);
}

TEST(PanelWithController, OffersTheShippedReferencesAndNamesWhoFollows) {
  const auto catalogue = nlohmann::json::parse(catalogue_json("process:mine {address}"));
  std::size_t offered = 0;
  for (const auto& entry : catalogue.at("experiments")) {
    if (entry.at("name").get<std::string>().starts_with("any-controller/")) {
      EXPECT_EQ(entry.at("controller"), "process:mine {address}");
      EXPECT_FALSE(entry.contains("trouble")) << entry.dump();
      ++offered;
    }
  }
  EXPECT_GE(offered, 11U);
}

TEST(PanelWithController, APageNamesNoCommand) {
  const TemporaryFolder out;
  Session session(out.path(), ExternalController{.command = "exit 1"});
  EXPECT_NE(steer(session, R"({"do": "start", "experiment": "any-controller/../circle",
                               "lines": [], "speed": 0})"),
            "");
}

}  // namespace
}  // namespace towbench::harness
