#include "harness/foreign_plant/fmu_functions.h"

#include <dlfcn.h>
#include <fmt/format.h>

namespace towbench::harness {
namespace {

class Finder {
 public:
  Finder(void* library, std::string& why) : library_(library), why_(why) {}
  template <typename Function>
  Finder& find(const char* name, Function& function) {
    function = reinterpret_cast<Function>(dlsym(library_, name));  // NOLINT: dlsym's own way
    if (function == nullptr && why_.empty()) {
      why_ = fmt::format("lacks the function {}", name);
    }
    return *this;
  }

 private:
  void* library_;
  std::string& why_;
};

}  // namespace

bool load_fmu_functions(const std::filesystem::path& library, bool with_state, fmi3::Functions& f,
                        std::string& why) {
  void* const loaded = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (loaded == nullptr) {
    why = fmt::format("cannot be loaded: {}", dlerror());
    return false;
  }
  why.clear();
  Finder finder(loaded, why);
  finder.find("fmi3GetVersion", f.get_version)
      .find("fmi3InstantiateCoSimulation", f.instantiate)
      .find("fmi3FreeInstance", f.free_instance)
      .find("fmi3EnterInitializationMode", f.enter_initialization)
      .find("fmi3ExitInitializationMode", f.exit_initialization)
      .find("fmi3Terminate", f.terminate)
      .find("fmi3GetFloat64", f.get_float64)
      .find("fmi3SetFloat64", f.set_float64)
      .find("fmi3SetBoolean", f.set_boolean)
      .find("fmi3DoStep", f.do_step);
  if (with_state) {
    finder.find("fmi3GetFMUState", f.get_state)
        .find("fmi3SetFMUState", f.set_state)
        .find("fmi3FreeFMUState", f.free_state)
        .find("fmi3SerializedFMUStateSize", f.state_size)
        .find("fmi3SerializeFMUState", f.serialize)
        .find("fmi3DeserializeFMUState", f.deserialize);
  }
  return why.empty();
}

}  // namespace towbench::harness
