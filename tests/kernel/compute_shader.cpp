#include "kernel/compute_shader.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <stdexcept>
#include <vulkan/vulkan_raii.hpp>

namespace brume {

namespace {

constexpr std::uint32_t buffer_count = 3;

vk::raii::Instance make_instance(const vk::raii::Context& context) {
  const vk::ApplicationInfo application("brume tests", 1, nullptr, 0, VK_API_VERSION_1_2);
  return {context, vk::InstanceCreateInfo({}, &application)};
}

std::vector<std::uint32_t> read_words(const std::filesystem::path& path) {
  std::vector<std::uint32_t> words(std::filesystem::file_size(path) / sizeof(std::uint32_t));
  std::ifstream file(path, std::ios::binary);
  file.read(reinterpret_cast<char*>(words.data()), static_cast<std::streamsize>(words.size() * sizeof(std::uint32_t)));
  if (!file) throw std::runtime_error("cannot read " + path.string());
  return words;
}

std::uint32_t compute_queue_family(const vk::raii::PhysicalDevice& device) {
  const auto families = device.getQueueFamilyProperties();
  for (std::uint32_t i = 0; i < families.size(); ++i)
    if (families[i].queueFlags & vk::QueueFlagBits::eCompute) return i;
  throw std::runtime_error("the Vulkan device has no queue for compute shaders");
}

vk::raii::Device make_device(const vk::raii::PhysicalDevice& physical, std::uint32_t family) {
  constexpr float priority = 1;
  const vk::DeviceQueueCreateInfo queue({}, family, 1, &priority);
  return {physical, vk::DeviceCreateInfo({}, queue)};
}

vk::raii::DescriptorSetLayout make_set_layout(const vk::raii::Device& device) {
  std::array<vk::DescriptorSetLayoutBinding, buffer_count> bindings;
  for (std::uint32_t i = 0; i < buffer_count; ++i)
    bindings[i] = {i, vk::DescriptorType::eStorageBuffer, 1, vk::ShaderStageFlagBits::eCompute};
  return {device, vk::DescriptorSetLayoutCreateInfo({}, bindings)};
}

vk::raii::PipelineLayout make_layout(const vk::raii::Device& device, vk::DescriptorSetLayout set, std::size_t pushed) {
  const vk::PushConstantRange range(vk::ShaderStageFlagBits::eCompute, 0,
                                    static_cast<std::uint32_t>(pushed * sizeof(std::uint32_t)));
  return {device, vk::PipelineLayoutCreateInfo({}, set, range)};
}

vk::raii::Pipeline make_pipeline(const vk::raii::Device& device, vk::PipelineLayout layout,
                                 const std::vector<std::uint32_t>& spirv) {
  const vk::raii::ShaderModule shader(device, vk::ShaderModuleCreateInfo({}, spirv));
  const vk::PipelineShaderStageCreateInfo stage({}, vk::ShaderStageFlagBits::eCompute, *shader, "main");
  return {device, nullptr, vk::ComputePipelineCreateInfo({}, stage, layout)};
}

// A storage buffer in memory that the host sees.
struct Buffer {
  Buffer(const vk::raii::Device& device, const vk::raii::PhysicalDevice& physical, std::size_t word_count)
      : buffer(device,
               vk::BufferCreateInfo({}, word_count * sizeof(std::uint32_t), vk::BufferUsageFlagBits::eStorageBuffer)),
        memory(allocate(device, physical, buffer.getMemoryRequirements())),
        size(word_count) {
    buffer.bindMemory(*memory, 0);
    words = static_cast<std::uint32_t*>(memory.mapMemory(0, VK_WHOLE_SIZE));
  }

  static vk::raii::DeviceMemory allocate(const vk::raii::Device& device, const vk::raii::PhysicalDevice& physical,
                                         const vk::MemoryRequirements& needs) {
    constexpr auto wanted = vk::MemoryPropertyFlagBits::eHostVisible | vk::MemoryPropertyFlagBits::eHostCoherent;
    const vk::PhysicalDeviceMemoryProperties all = physical.getMemoryProperties();
    for (std::uint32_t i = 0; i < all.memoryTypeCount; ++i)
      if ((needs.memoryTypeBits >> i & 1) && (all.memoryTypes[i].propertyFlags & wanted) == wanted)
        return {device, vk::MemoryAllocateInfo(needs.size, i)};
    throw std::runtime_error("the Vulkan device has no memory that the host sees");
  }

  vk::raii::Buffer buffer;
  vk::raii::DeviceMemory memory;
  std::size_t size;
  std::uint32_t* words = nullptr;
};

}  // namespace

std::vector<std::string> vulkan_device_names() {
  std::vector<std::string> names;
  try {
    const vk::raii::Context context;
    const vk::raii::Instance instance = make_instance(context);
    for (const vk::raii::PhysicalDevice& device : vk::raii::PhysicalDevices(instance))
      names.emplace_back(device.getProperties().deviceName.data());
  } catch (const vk::SystemError&) {  // there is no driver
  }
  return names;
}

struct ComputeShader::Impl {
  Impl(std::size_t device_index, const std::vector<std::uint32_t>& spirv, std::size_t pushed)
      : instance(make_instance(context)),
        physical(std::move(vk::raii::PhysicalDevices(instance).at(device_index))),
        family(compute_queue_family(physical)),
        device(make_device(physical, family)),
        set_layout(make_set_layout(device)),
        layout(make_layout(device, *set_layout, pushed)),
        pipeline(make_pipeline(device, *layout, spirv)) {}

  vk::raii::Context context;
  vk::raii::Instance instance;
  vk::raii::PhysicalDevice physical;
  std::uint32_t family;
  vk::raii::Device device;
  vk::raii::DescriptorSetLayout set_layout;
  vk::raii::PipelineLayout layout;
  vk::raii::Pipeline pipeline;
};

ComputeShader::ComputeShader(std::size_t device, const std::filesystem::path& spirv, std::size_t pushed)
    : impl_(std::make_unique<Impl>(device, read_words(spirv), pushed)) {}

ComputeShader::~ComputeShader() = default;

std::vector<std::uint32_t> ComputeShader::run(std::uint32_t groups, std::span<const std::uint32_t> push,
                                              std::span<const std::uint32_t> table,
                                              std::span<const std::uint32_t> arguments, std::size_t results) {
  const Impl& it = *impl_;
  const std::array<Buffer, buffer_count> buffers{Buffer(it.device, it.physical, table.size()),
                                                 Buffer(it.device, it.physical, arguments.size()),
                                                 Buffer(it.device, it.physical, results)};
  std::ranges::copy(table, buffers[0].words);
  std::ranges::copy(arguments, buffers[1].words);

  const vk::DescriptorPoolSize pool_size(vk::DescriptorType::eStorageBuffer, buffer_count);
  const vk::raii::DescriptorPool pool(
      it.device, vk::DescriptorPoolCreateInfo(vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 1, pool_size));
  const vk::raii::DescriptorSets sets(it.device, vk::DescriptorSetAllocateInfo(*pool, *it.set_layout));
  for (std::uint32_t i = 0; i < buffer_count; ++i) {
    const vk::DescriptorBufferInfo info(*buffers[i].buffer, 0, VK_WHOLE_SIZE);
    it.device.updateDescriptorSets(
        vk::WriteDescriptorSet(*sets[0], i, 0, vk::DescriptorType::eStorageBuffer, {}, info, {}), {});
  }

  const vk::raii::CommandPool command_pool(it.device, vk::CommandPoolCreateInfo({}, it.family));
  const vk::raii::CommandBuffers commands(
      it.device, vk::CommandBufferAllocateInfo(*command_pool, vk::CommandBufferLevel::ePrimary, 1));
  const vk::raii::CommandBuffer& command = commands[0];
  command.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
  command.bindPipeline(vk::PipelineBindPoint::eCompute, *it.pipeline);
  command.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *it.layout, 0, *sets[0], {});
  command.pushConstants<std::uint32_t>(
      *it.layout, vk::ShaderStageFlagBits::eCompute, 0,
      vk::ArrayProxy<const std::uint32_t>(static_cast<std::uint32_t>(push.size()), push.data()));
  command.dispatch(groups, 1, 1);
  // The host reads what the shader has written.
  command.pipelineBarrier(vk::PipelineStageFlagBits::eComputeShader, vk::PipelineStageFlagBits::eHost, {},
                          vk::MemoryBarrier(vk::AccessFlagBits::eShaderWrite, vk::AccessFlagBits::eHostRead), {}, {});
  command.end();

  const vk::raii::Queue queue(it.device, it.family, 0);
  queue.submit(vk::SubmitInfo({}, {}, *command));
  queue.waitIdle();
  return {buffers[2].words, buffers[2].words + results};
}

}  // namespace brume
