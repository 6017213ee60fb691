#include "harness/run/real_time_runner.h"

#include "harness/link/witnessed_plant.h"
#include "harness/realtime/realtime_plant.h"
#include "harness/realtime/wall_clock_carrier.h"
#include "harness/record/message_record.h"
#include "harness/run/carrier_name.h"
#include "harness/run/conversation.h"
#include "protocol/tee_sink.h"

namespace towbench::harness {

RunOutcome RealTimeRunner::play_over(EmulatorProcess& child, protocol::Connection& connection,
                                     CanLog* log) {
  MessageRecord heard(plan().folder / kControllerInputsFile);
  CanLogClock log_clock(log);
  protocol::TeeSink witness(log_clock, heard.sink());
  go_by_the_wall_clock(connection);
  timing_.emplace(plan().folder, plan().fixture.controller.configuration);
  RealtimePlantEnd timed(connection.link(), timing_->loop(), takes_edges(plan().options));
  auto outcome = with_lines(timed, EdgeTimes::kOfKernel, [&](PlantEnd& whole) {
    WitnessedPlant plant(whole, witness);
    return converse(plan(), plant, child);
  });
  heard.flush();
  outcome.writes_succeeded = outcome.writes_succeeded && heard.good();
  return outcome;
}

void RealTimeRunner::judge_into(RunResult& result, const RunOutcome& outcome) {
  Runner::judge_into(result, outcome);
  if (timing_) {
    result.timing =
        timing_->judge_into(result.judgement, outcome.control_period_ns, *plan().realtime_budget);
  }
}

}  // namespace towbench::harness
