// What FMI 3.0 declares of a Co-Simulation unit (FMI 3.0.1, 2.2.1 to 2.2.6 and 4.2), written from
// the specification. Modelica Association, https://fmi-standard.org.
#pragma once

#include <cstddef>
#include <cstdint>

namespace towbench::fmi3 {

using Instance = void*;
using State = void*;  // fmi3FMUState
using ValueReference = std::uint32_t;

enum class Status : int { kOk, kWarning, kDiscard, kError, kFatal };

inline constexpr const char* kVersion = "3.0";
// Of a shared library in binaries/, on this machine.
inline constexpr const char* kPlatform = "x86_64-linux";

using LogMessage = void (*)(void* environment, Status status, const char* category,
                            const char* message);
using IntermediateUpdate = void (*)(void* environment, double time, bool set_requested,
                                    bool get_allowed, bool step_finished, bool can_return_early,
                                    bool* return_requested, double* return_time);

// The types of the functions that both sides of the bench use.
struct Functions {
  const char* (*get_version)() = nullptr;
  Instance (*instantiate)(const char* name, const char* token, const char* resource_path,
                          bool visible, bool logging_on, bool event_mode_used,
                          bool early_return_allowed, const ValueReference required[],
                          std::size_t required_count, void* environment, LogMessage log,
                          IntermediateUpdate update) = nullptr;
  void (*free_instance)(Instance) = nullptr;
  Status (*enter_initialization)(Instance, bool tolerance_defined, double tolerance,
                                 double start_time, bool stop_defined, double stop_time) = nullptr;
  Status (*exit_initialization)(Instance) = nullptr;
  Status (*terminate)(Instance) = nullptr;
  Status (*get_float64)(Instance, const ValueReference[], std::size_t, double[],
                        std::size_t) = nullptr;
  Status (*set_float64)(Instance, const ValueReference[], std::size_t, const double[],
                        std::size_t) = nullptr;
  Status (*set_boolean)(Instance, const ValueReference[], std::size_t, const bool[],
                        std::size_t) = nullptr;
  Status (*do_step)(Instance, double time, double step, bool no_set_state_before,
                    bool* event_needed, bool* terminate_wanted, bool* early_return,
                    double* last_time) = nullptr;
  Status (*get_state)(Instance, State*) = nullptr;
  Status (*set_state)(Instance, State) = nullptr;
  Status (*free_state)(Instance, State*) = nullptr;
  Status (*state_size)(Instance, State, std::size_t*) = nullptr;
  Status (*serialize)(Instance, State, std::uint8_t[], std::size_t) = nullptr;
  Status (*deserialize)(Instance, const std::uint8_t[], std::size_t, State*) = nullptr;
};

}  // namespace towbench::fmi3
