// Runs a compute shader of three storage buffers on a Vulkan device.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace brume {

// The names of the machine's Vulkan devices; none where it has no driver.
std::vector<std::string> vulkan_device_names();

class ComputeShader {
 public:
  // Throws std::runtime_error where the device, by its place among the names, refuses the shader. `pushed` is the
  // number of words of push constants.
  ComputeShader(std::size_t device, const std::filesystem::path& spirv, std::size_t pushed);
  ~ComputeShader();

  // Runs `groups` workgroups over buffers 0 and 1, which hold `table` and `arguments`; returns the words of buffer 2.
  std::vector<std::uint32_t> run(std::uint32_t groups, std::span<const std::uint32_t> push,
                                 std::span<const std::uint32_t> table, std::span<const std::uint32_t> arguments,
                                 std::size_t results);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace brume
