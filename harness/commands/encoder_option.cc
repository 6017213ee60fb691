#include "harness/commands/encoder_option.h"

#include <algorithm>

#include "harness/fixtures/fixture_error.h"
#include "harness/run/encoder_rate.h"
#include "protocol/carriers/encoder_address.h"

namespace towbench::harness {
namespace {

FixtureError refusal(std::string given, std::string allowed) {
  return {{"command line", 0, "--encoder-lines"}, std::move(given), std::move(allowed)};
}

protocol::EncoderAddress parsed(const std::string& text) {
  auto address = protocol::parse_encoder_address(text);
  if (!address) {
    throw refusal('"' + text + '"', std::string(protocol::kEncoderLineForms));
  }
  return *address;
}

double smaller_rating(double one, double other) {
  return one == 0 || other == 0 ? std::max(one, other) : std::min(one, other);
}

EdgeCapacity measured(const protocol::EncoderAddress& controller,
                      const protocol::EncoderAddress& plant) {
  const auto reader = protocol::open_edge_reader(controller);
  if (!reader) {
    throw std::runtime_error(reader.error().message);
  }
  const auto driver = protocol::open_edge_driver(plant);
  if (!driver) {
    throw std::runtime_error(driver.error().message);
  }
  const auto rate = measure_edges_per_s(**driver, **reader);
  if (!rate) {
    throw std::runtime_error("encoder lines: edges driven at " + plant.place.chip +
                             " do not arrive at " + controller.place.chip);
  }
  return {.edges_per_s = kMaxEdgeLoad * *rate, .source = "80 % of what was measured just now"};
}

}  // namespace

void choose_encoder_lines(const std::string& text, RunOptions& options) {
  if (text.empty()) {
    return;
  }
  const auto comma = text.find(',');
  if (comma == std::string::npos) {
    throw refusal('"' + text + '"', "CONTROLLER,PLANT");
  }
  options.encoder_lines = {text.substr(0, comma), text.substr(comma + 1)};
  const auto controller = parsed(options.encoder_lines.controller);
  const auto plant = parsed(options.encoder_lines.plant);
  if (controller.is_simulated || controller.place.with_index != plant.place.with_index) {
    throw refusal('"' + text + '"', "sim: at the machine's end only, :index at both or at none");
  }
  if (options.carrier == Carrier::kInProcess) {
    options.carrier = Carrier::kLocal;
  }
}

void check_encoder_lines(const ExperimentFixture& fixture, const RunOptions& options) {
  if (options.encoder_lines.controller.empty()) {
    return;
  }
  const auto controller = parsed(options.encoder_lines.controller);
  const auto plant = parsed(options.encoder_lines.plant);
  for (const auto& axis : fixture.controller.configuration.axes) {
    if (axis.exists && axis.plausibility.index_fitted && !plant.place.with_index) {
      throw refusal("no index for a controller that expects one",
                    ":index at both ends, or index_fitted = false in the controller's file");
    }
  }
  EdgeCapacity capacity{
      .edges_per_s = smaller_rating(controller.rated_edges_per_s, plant.rated_edges_per_s),
      .source = "as rated"};
  if (capacity.edges_per_s == 0 && options.clock == RunClock::kReal) {
    capacity = measured(controller, plant);
  }
  const auto peak = rehearse_edges(fixture, options.seed.value_or(fixture.experiment.seed));
  if (const auto bears = accept_edges(peak, capacity); !bears) {
    throw refusal(bears.error().message, "a slower experiment, or the encoders over the carrier");
  }
}

}  // namespace towbench::harness
