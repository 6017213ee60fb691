// A log of the bench's own rig, with one thing in the machine other than its plant file says.
//
// The machine is the emulator, the controller BBMC, the model what
// fixtures/plants/macs-nominal.toml states: elastic transmission, Stribeck, friction by place. The
// diagnosis shares no code with the plant.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "study/diagnose/diagnosis.h"

namespace towbench::tests {

struct BenchCase {
  std::string effect = {};  // a name of bench_effects(), empty: the machine is as stated
  double strength = 1;
  std::uint64_t seed = 1;
};

// What can be hidden in the emulator by a parameter of its own.
// `alone`: only those that are named with nothing beside them.
[[nodiscard]] std::vector<std::string> bench_effects(bool alone = false);
// Trapezoids both ways along Y, speeds and ways drawn from the seed, about 50 s.
[[nodiscard]] study::diagnose::Run bench_run(const BenchCase& one);
[[nodiscard]] study::diagnose::Diagnosis diagnose_bench(const BenchCase& one);

}  // namespace towbench::tests
