// A unit unpacked into a folder of its own, which is gone when nobody uses it any more.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include <sys/types.h>

#include "harness/fmi/fmu_description.h"

namespace towbench::harness {

class UnpackedFmu {
 public:
  // Null: `why` says it in half a sentence. Throws std::filesystem::filesystem_error.
  [[nodiscard]] static std::shared_ptr<const UnpackedFmu> open(const std::string& archive,
                                                               std::string& why);
  UnpackedFmu(const UnpackedFmu&) = delete;
  UnpackedFmu& operator=(const UnpackedFmu&) = delete;
  ~UnpackedFmu();

  [[nodiscard]] const FmuDescription& description() const noexcept { return description_; }
  [[nodiscard]] std::filesystem::path library() const;
  [[nodiscard]] std::string resources() const;  // ends with a separator

 private:
  UnpackedFmu();
  [[nodiscard]] std::string unpack(const std::string& archive);

  std::filesystem::path folder_;
  pid_t owner_;  // a forked process leaves the folder to the one that made it
  FmuDescription description_;
};

}  // namespace towbench::harness
