// What a link does to messages, over each carrier that needs no bus: the same motion and the same
// end as in one process, to the last bit. Over CAN the same faults run in the test machine
// (fixtures/campaigns/can.toml); what happens to a wire's own frames is in wire_faults_test.cc.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/fault_cases/faulted_experiment.h"
#include "harness/fault_plan/fault_text.h"
#include "tests/harness/end_to_end/run_support.h"

namespace towbench::harness {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

struct LinkCase {
  const char* words;
  Carrier carrier;
  unsigned latched;  // 0: nothing
};

class LinkFaultOverACarrier : public testing::TestWithParam<LinkCase> {};

TEST_P(LinkFaultOverACarrier, EndsInTheDocumentedStateWithTheFilesOfARunInOneProcess) {
  Runs runs;
  auto fixture = Runs::shipped("wall-clock-window");
  add_faults(fixture, {parse_fault(GetParam().words)});
  const auto run = runs.run(fixture, GetParam().carrier);
  ASSERT_NE(check_named(run, "fault_fired"), nullptr) << complaints_of(run);
  EXPECT_EQ(check_named(run, "fault_fired")->verdict, Verdict::kPass) << complaints_of(run);
  EXPECT_EQ(check_named(run, "recorded_run_is_judged")->verdict, Verdict::kPass);
  ASSERT_TRUE(run.faults.has_value()) << run.reason;
  EXPECT_TRUE(run.faults->handled) << complaints_of(run);
  const auto events = contents_of(run.folder / "events.jsonl");
  if (GetParam().latched == 0) {
    EXPECT_THAT(events, Not(HasSubstr("fault_latched")));
  } else {
    EXPECT_THAT(events, HasSubstr("fault_latched"));
    EXPECT_THAT(events, HasSubstr("\"code\":" + std::to_string(GetParam().latched)));
  }
  // A plant that is killed takes the end of its record along.
  if (std::string_view(GetParam().words).find("peer_killed") == std::string_view::npos) {
    const auto memory = runs.run(fixture);
    for (const char* file : {"log.csv", "truth.csv", "events.jsonl"}) {
      EXPECT_TRUE(contents_of(run.folder / file) == contents_of(memory.folder / file)) << file;
    }
  }
}

std::vector<LinkCase> link_cases() {
  std::vector<LinkCase> cases;
  for (const auto carrier : {Carrier::kLocal, Carrier::kSerialPty}) {
    cases.push_back({"link.to_controller loss at=0.9s", carrier, 321});
    cases.push_back({"link.to_controller reorder at=0.9s", carrier, 321});
    cases.push_back({"link.to_controller corrupt_byte at=0.9s", carrier, 321});
    cases.push_back({"link.to_controller duplicate at=0.9s", carrier, 321});
    cases.push_back({"link.to_controller delay at=0.9s delay=50ms", carrier, 320});
    cases.push_back({"link.to_controller jitter at=0.9s delay=100ms", carrier, 320});
    cases.push_back({"link.to_controller flood at=0.9s", carrier, 0});
    cases.push_back({"link.to_controller peer_killed at=0.9s", carrier, 320});
    cases.push_back({"link.to_plant loss at=0.9s", carrier, 321});
    cases.push_back({"link.to_plant reorder at=0.9s", carrier, 321});
    cases.push_back({"link.to_plant corrupt_byte at=0.9s", carrier, 321});
    cases.push_back({"link.to_plant duplicate at=0.9s", carrier, 321});
    // As the motion begins, every one.
    cases.push_back({"link.to_plant duplicate at=0.52s probability=1", carrier, 321});
  }
  return cases;
}

INSTANTIATE_TEST_SUITE_P(Carriers, LinkFaultOverACarrier, testing::ValuesIn(link_cases()),
                         [](const auto& each) {
                           std::string name = each.param.words;
                           name = name.substr(name.find('.') + 1);
                           name = name.substr(0, name.find(' ', name.find(' ') + 1));
                           name[name.find(' ')] = '_';
                           const std::string_view words = each.param.words;
                           name += words.find("probability") != words.npos ? "_of_all" : "";
                           return name + (each.param.carrier == Carrier::kLocal ? "_over_a_socket"
                                                                                : "_over_a_line");
                         });

}  // namespace
}  // namespace towbench::harness
