// A cause that a model may lack: keys of the axis that are set. One name each, part of the
// interface.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "study/prediction/context.h"
#include "study/prediction/plant_values.h"

namespace towbench::study::diagnose {

using Scales = std::vector<double>;

struct Effect {
  std::string name = {};
  std::string cause = {};  // in words, after "the model lacks"
  std::string needs = {};  // the data that would show it
  std::string law = {};    // what is added to the forces that act, load side
  std::string source = {};
  // Linear in the force: one column each. Empty: the effect as it is set is one column, and its
  // coefficient is 1 where it is right.
  std::vector<Key> amplitudes = {};
  std::vector<std::string> amplitude_names = {};  // with units
  // Where they begin, and what a fit may move.
  std::vector<Key> scales = {};
  std::vector<std::string> scale_names = {};
  bool positive = false;    // its first amplitude; otherwise the physics allows both signs
  std::string covers = {};  // an effect that is one of its shapes
  double least = 0;         // of its first amplitude's size, that is worth a name
  double most = 0;          // of its first amplitude's size; 0: no limit
  double own = 0.02;        // least share of its shape that the model must be unable to make
  bool flexible = false;    // a free shape, that takes on what is not its own
  std::string along{};      // what it is a force of, in any shape; empty: its law is a certain one
  double finer = 0;         // of its force, that finer shapes along it make at most; 0: no limit
  double whole = 0;         // the amplitude that its law fixes; 0: none
  bool rough = false;       // a fit of it has many minima: begun from all of its grid
  bool structural = false;  // so large where it acts that no fit without it means anything
  int other = -1;           // which of the log's other axes it is about; -1: none
  // The base key that the mean of its shape falls into: with the effect found, that parameter is
  // not comparable with the supplied one. kCount: none.
  Key shares_mean_with = Key::kCount;
  std::vector<Scales> (*grid)(const Context&) = nullptr;
  // Sets scales and whatever else it needs; amplitudes stay.
  void (*set)(Parameters&, const Context&, std::span<const double>) = nullptr;
  double (*step)(const Context&) = nullptr;  // of an amplitude, for its derivative
  // With which it is sought as well where its force is far from linear in the amplitude, or null.
  double (*far_step)(const Context&) = nullptr;
  // Keys of the plant file below [axis.NAME], or of its water, and their values. Empty: the
  // emulator cannot express it.
  std::vector<std::string> plant_keys = {};
  PlantValues (*plant_values)(const Parameters&, const StatedPlant&) = nullptr;

  // Of the command or of the drive: its level is the scale.
  [[nodiscard]] bool is_clip() const { return whole != 0 && !amplitudes.empty(); }
};

// The families; each in a file of its own.
void add_friction_effects(std::vector<Effect>& library);
void add_drive_effects(std::vector<Effect>& library);
void add_mechanical_effects(std::vector<Effect>& library);
void add_place_effects(std::vector<Effect>& library);
void add_periodic_effects(std::vector<Effect>& library);
void add_cross_axis_effects(std::vector<Effect>& library);

[[nodiscard]] const std::vector<Effect>& effects();
[[nodiscard]] const Effect* find_effect(std::string_view name);

}  // namespace towbench::study::diagnose
