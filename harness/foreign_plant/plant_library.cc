#include "harness/foreign_plant/plant_library.h"

#include <array>

#include <dlfcn.h>
#include <fmt/format.h>

#include "core/time.h"

namespace towbench::harness {
namespace {

// Loaded once a process, which ends with it: never closed.
struct Functions {
  decltype(&towbench_plant_abi_version) version = nullptr;
  decltype(&towbench_plant_create) create = nullptr;
  decltype(&towbench_plant_destroy) destroy = nullptr;
  decltype(&towbench_plant_step) step = nullptr;
  decltype(&towbench_plant_state_size) state_size = nullptr;
  decltype(&towbench_plant_save) save = nullptr;
  decltype(&towbench_plant_restore) restore = nullptr;
};

template <typename Function>
bool find(void* library, const char* name, Function& function, std::string& why) {
  function = reinterpret_cast<Function>(dlsym(library, name));  // NOLINT: dlsym's own way
  if (function == nullptr) {
    why = fmt::format("lacks the function {}", name);
  }
  return function != nullptr;
}

bool open(const std::filesystem::path& file, Functions& f, std::string& why) {
  void* const library = dlopen(std::filesystem::absolute(file).c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    why = fmt::format("cannot be loaded: {}", dlerror());
    return false;
  }
  if (!find(library, "towbench_plant_abi_version", f.version, why)) {
    return false;
  }
  if (const auto version = f.version(); version != TOWBENCH_PLANT_ABI_VERSION) {
    why =
        fmt::format("has version {} of the interface, not {}", version, TOWBENCH_PLANT_ABI_VERSION);
    return false;
  }
  return find(library, "towbench_plant_create", f.create, why) &&
         find(library, "towbench_plant_destroy", f.destroy, why) &&
         find(library, "towbench_plant_step", f.step, why) &&
         find(library, "towbench_plant_state_size", f.state_size, why) &&
         find(library, "towbench_plant_save", f.save, why) &&
         find(library, "towbench_plant_restore", f.restore, why);
}

class Loaded final : public LoadedPlant {
 public:
  Loaded(const Functions& functions, void* plant) noexcept : f_(functions), plant_(plant) {}
  Loaded(const Loaded&) = delete;
  Loaded& operator=(const Loaded&) = delete;
  ~Loaded() override { f_.destroy(plant_); }

  bool step(double until_s, const towbench_plant_input* inputs, towbench_plant_output* outputs,
            double& reached_s, char* message, std::size_t size) override {
    return f_.step(plant_, until_s, inputs, outputs, &reached_s, message, size) == 0;
  }
  std::size_t state_size() override { return f_.state_size(plant_); }
  bool save(void* state) override { return f_.save(plant_, state) == 0; }
  bool restore(const void* state) override { return f_.restore(plant_, state) == 0; }

 private:
  Functions f_;
  void* plant_;
};

}  // namespace

std::unique_ptr<LoadedPlant> PlantLibrary::load(const std::vector<PlantAxis>& axes,
                                                std::string& why) const {
  Functions functions;
  if (!open(file_, functions, why)) {
    return nullptr;
  }
  std::vector<towbench_plant_axis> told;
  for (const auto& axis : axes) {
    told.push_back({axis.name.c_str(), axis.start_m});
  }
  const towbench_plant_setup setup{.axes = told.data(),
                                   .axis_count = told.size(),
                                   .step_s = core::kPlantTick_s,
                                   .parameters = parameters_.c_str()};
  std::array<char, 256> message{};
  void* const plant = functions.create(&setup, message.data(), message.size());
  if (plant == nullptr) {
    message.back() = '\0';
    why = message.front() == '\0' ? "makes no plant, and does not say why" : message.data();
    return nullptr;
  }
  return std::make_unique<Loaded>(functions, plant);
}

}  // namespace towbench::harness
