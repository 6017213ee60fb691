// replay INPUTS DUTY: the controller fed with recorded messages and nothing else. Builds for any
// target that has a C++20 compiler; tools/armhf_duty.sh builds it for armhf and compares DUTY.
#include <cstdio>
#include <memory>
#include <vector>

#include "bbmc/host/emulated_board.h"
#include "tests/bbmc/portable/duty_sink.h"
#include "tests/bbmc/portable/script.h"

namespace {

using namespace towbench;

// False at the end, or where the record is damaged.
bool take_until_service(std::FILE* file, bbmc::EmulatedBoard& board, protocol::EncoderEdges& edges,
                        bool& damaged) {
  char kind = 0;
  while (std::fscanf(file, " %c", &kind) == 1) {
    long long first = 0;
    long long second = 0;
    if (kind == 'S') {
      damaged = std::fscanf(file, "%lld", &first) != 1;
      return !damaged;
    }
    if (kind == 'D') {
      unsigned lines = 0;
      protocol::DigitalInputs inputs;
      damaged = std::fscanf(file, "%u %lld %u", &lines, &first, &inputs.sequence) != 3;
      inputs.lines = static_cast<protocol::InputLines>(lines);
      inputs.change_ns = first;
      damaged = damaged || !board.take(inputs);
    } else if (kind == 'E') {
      int axis = 0;
      int levels = 0;
      unsigned size = 0;
      edges.edges.clear();
      damaged = std::fscanf(file, "%d %d %lld %lld %u %u", &axis, &levels, &first, &second,
                            &edges.sequence, &size) != 6;
      edges.axis = axis == 0 ? core::Axis::kY : core::Axis::kX;
      edges.start_levels = static_cast<protocol::EncoderLevels>(levels);
      edges.start_ns = first;
      edges.end_ns = second;
      for (unsigned i = 0; i < size && !damaged; ++i) {
        unsigned packed = 0;
        damaged = std::fscanf(file, "%u", &packed) != 1 ||
                  !edges.edges.push_back(protocol::EncoderEdge::from_packed(packed));
      }
      damaged = damaged || !board.take(edges);
    } else {
      damaged = true;
    }
    if (damaged) {
      return false;
    }
  }
  return false;
}

}  // namespace

int main(int argc, char** argv) {
  std::FILE* const inputs = argc == 3 ? std::fopen(argv[1], "r") : nullptr;
  std::FILE* const duty = argc == 3 ? std::fopen(argv[2], "w") : nullptr;
  if (inputs == nullptr || duty == nullptr) {
    std::fputs("usage: bbmc_replay INPUTS DUTY\n", stderr);
    return 2;
  }
  const auto board = std::make_unique<bbmc::EmulatedBoard>();
  bbmc::DeviceManager devices(board->ports());
  std::vector<bbmc::DataLogRow> log(bbmc::kDataLogRows);
  const auto system =
      std::make_unique<bbmc::SystemManager>(portable::configuration(), devices, log);
  portable::DutySink sink(duty, nullptr);
  if (!system->start()) {
    return 1;
  }
  const auto edges = std::make_unique<protocol::EncoderEdges>();
  bool damaged = false;
  long exchange = 0;
  while (take_until_service(inputs, *board, *edges, damaged)) {
    if (!portable::serve(*board, *system, exchange, sink)) {
      std::fprintf(stderr, "refused at exchange %ld\n", exchange);
      return 1;
    }
    ++exchange;
  }
  if (damaged || exchange != portable::kExchanges) {
    std::fprintf(stderr, "damaged record at exchange %ld\n", exchange);
    return 1;
  }
  return std::fclose(duty) == 0 ? 0 : 1;
}
