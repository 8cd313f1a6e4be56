// SPDX-License-Identifier: MIT
#include "vulkan_compute.h"

#include <vulkan/vulkan.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <utility>

namespace tspace::shaders {

namespace {

/// Owns Vulkan objects: its destructor calls their destroy functions in reverse order.
class Owned {
  public:
    ~Owned() {
        while (!undo_.empty()) {
            undo_.back()();
            undo_.pop_back();
        }
    }
    Owned() = default;
    Owned(const Owned&) = delete;
    Owned& operator=(const Owned&) = delete;
    template <class F>
    void add(F&& undo) {
        undo_.emplace_back(std::forward<F>(undo));
    }

  private:
    std::vector<std::function<void()>> undo_;
};

struct Failed {
    std::string what;
};
void must(VkResult result, const char* what) {
    if (result != VK_SUCCESS) throw Failed{std::string(what) + " failed: " + std::to_string(result)};
}

struct Buffer {
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
};

class Device final : public VulkanCompute {
  public:
    Device() {
        const VkApplicationInfo application{.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                            .pNext = nullptr,
                                            .pApplicationName = "tspace shader test",
                                            .applicationVersion = 0,
                                            .pEngineName = nullptr,
                                            .engineVersion = 0,
                                            .apiVersion = VK_API_VERSION_1_0};
        VkInstanceCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
        info.pApplicationInfo = &application;
        must(vkCreateInstance(&info, nullptr, &instance_), "vkCreateInstance");
        owned_.add([this] { vkDestroyInstance(instance_, nullptr); });
        choosePhysicalDevice();
        chooseQueue();
    }

    [[nodiscard]] std::string device() const override { return name_; }

    std::string run(std::span<const std::uint32_t> spirv, std::span<const std::uint32_t> words, std::size_t items,
                    std::vector<float>& results) override {
        try {
            Owned owned;
            const std::size_t result_bytes = results.size() * sizeof(float);
            const Buffer in = makeBuffer(owned, words.size_bytes()), out = makeBuffer(owned, result_bytes);
            copyIn(in, words.data(), words.size_bytes());
            const Buffer both[] = {in, out};
            dispatch(owned, spirv, "main", both, static_cast<std::uint32_t>((items + 63) / 64));
            copyOut(out, results.data(), result_bytes);
            return {};
        } catch (const Failed& failed) {
            return failed.what;
        }
    }

    std::string runBuffers(std::span<const std::uint32_t> spirv, const char* entry, std::uint32_t groups,
                           std::span<std::vector<std::uint32_t>> arrays) override {
        try {
            Owned owned;
            std::vector<Buffer> buffers;
            for (const std::vector<std::uint32_t>& array : arrays) {
                buffers.push_back(makeBuffer(owned, 4 * array.size()));
                copyIn(buffers.back(), array.data(), 4 * array.size());
            }
            dispatch(owned, spirv, entry, buffers, groups);
            for (std::size_t i = 0; i < arrays.size(); ++i) copyOut(buffers[i], arrays[i].data(), 4 * arrays[i].size());
            return {};
        } catch (const Failed& failed) {
            return failed.what;
        }
    }

  private:
    void choosePhysicalDevice() {
        std::uint32_t count = 0;
        must(vkEnumeratePhysicalDevices(instance_, &count, nullptr), "vkEnumeratePhysicalDevices");
        std::vector<VkPhysicalDevice> devices(count);
        must(vkEnumeratePhysicalDevices(instance_, &count, devices.data()), "vkEnumeratePhysicalDevices");
        for (const VkPhysicalDevice device : devices) {
            VkPhysicalDeviceProperties properties;
            vkGetPhysicalDeviceProperties(device, &properties);
            const bool is_software = properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
            if (physical_ != VK_NULL_HANDLE && !is_software) continue;
            physical_ = device;
            name_ = properties.deviceName;
            if (is_software) return;
        }
        if (physical_ == VK_NULL_HANDLE) throw Failed{"there is no Vulkan device"};
    }

    void chooseQueue() {
        std::uint32_t count = 0;
        vkGetPhysicalDeviceQueueFamilyProperties(physical_, &count, nullptr);
        std::vector<VkQueueFamilyProperties> families(count);
        vkGetPhysicalDeviceQueueFamilyProperties(physical_, &count, families.data());
        while (family_ < count && (families[family_].queueFlags & VK_QUEUE_COMPUTE_BIT) == 0) ++family_;
        if (family_ == count) throw Failed{"the Vulkan device computes nothing"};
        const float priority = 1;
        VkDeviceQueueCreateInfo queue{};
        queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
        queue.queueFamilyIndex = family_;
        queue.queueCount = 1;
        queue.pQueuePriorities = &priority;
        VkDeviceCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
        info.queueCreateInfoCount = 1;
        info.pQueueCreateInfos = &queue;
        must(vkCreateDevice(physical_, &info, nullptr, &device_), "vkCreateDevice");
        owned_.add([this] { vkDestroyDevice(device_, nullptr); });
        vkGetDeviceQueue(device_, family_, 0, &queue_);
    }

    /// Returns the index of a memory type that is coherent for the host.
    std::uint32_t memoryKind(std::uint32_t allowed) const {
        constexpr VkMemoryPropertyFlags kWanted =
            VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
        VkPhysicalDeviceMemoryProperties memory;
        vkGetPhysicalDeviceMemoryProperties(physical_, &memory);
        for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
            if ((allowed >> i & 1) != 0 && (memory.memoryTypes[i].propertyFlags & kWanted) == kWanted) return i;
        }
        throw Failed{"the Vulkan device shares no memory"};
    }

    Buffer makeBuffer(Owned& owned, std::size_t bytes) {
        VkBufferCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
        info.size = bytes;
        info.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
        info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
        Buffer made;
        must(vkCreateBuffer(device_, &info, nullptr, &made.buffer), "vkCreateBuffer");
        owned.add([this, made] { vkDestroyBuffer(device_, made.buffer, nullptr); });
        VkMemoryRequirements needs;
        vkGetBufferMemoryRequirements(device_, made.buffer, &needs);
        VkMemoryAllocateInfo memory{};
        memory.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
        memory.allocationSize = needs.size;
        memory.memoryTypeIndex = memoryKind(needs.memoryTypeBits);
        must(vkAllocateMemory(device_, &memory, nullptr, &made.memory), "vkAllocateMemory");
        owned.add([this, made] { vkFreeMemory(device_, made.memory, nullptr); });
        must(vkBindBufferMemory(device_, made.buffer, made.memory, 0), "vkBindBufferMemory");
        return made;
    }
    void copyIn(const Buffer& to, const void* from, std::size_t bytes) {
        void* mapped = nullptr;
        must(vkMapMemory(device_, to.memory, 0, bytes, 0, &mapped), "vkMapMemory");
        std::memcpy(mapped, from, bytes);
        vkUnmapMemory(device_, to.memory);
    }
    void copyOut(const Buffer& from, void* to, std::size_t bytes) {
        void* mapped = nullptr;
        must(vkMapMemory(device_, from.memory, 0, bytes, 0, &mapped), "vkMapMemory");
        std::memcpy(to, mapped, bytes);
        vkUnmapMemory(device_, from.memory);
    }

    VkDescriptorSetLayout makeSetLayout(Owned& owned, std::size_t count) {
        std::vector<VkDescriptorSetLayoutBinding> bindings(count);
        for (std::uint32_t i = 0; i < count; ++i) {
            bindings[i].binding = i;
            bindings[i].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
            bindings[i].descriptorCount = 1;
            bindings[i].stageFlags = VK_SHADER_STAGE_COMPUTE_BIT;
        }
        VkDescriptorSetLayoutCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
        info.bindingCount = static_cast<std::uint32_t>(count);
        info.pBindings = bindings.data();
        VkDescriptorSetLayout layout = VK_NULL_HANDLE;
        must(vkCreateDescriptorSetLayout(device_, &info, nullptr, &layout), "vkCreateDescriptorSetLayout");
        owned.add([this, layout] { vkDestroyDescriptorSetLayout(device_, layout, nullptr); });
        return layout;
    }

    VkDescriptorSet makeSet(Owned& owned, VkDescriptorSetLayout layout, std::span<const Buffer> all) {
        const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, static_cast<std::uint32_t>(all.size())};
        VkDescriptorPoolCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
        info.maxSets = 1;
        info.poolSizeCount = 1;
        info.pPoolSizes = &size;
        VkDescriptorPool pool = VK_NULL_HANDLE;
        must(vkCreateDescriptorPool(device_, &info, nullptr, &pool), "vkCreateDescriptorPool");
        owned.add([this, pool] { vkDestroyDescriptorPool(device_, pool, nullptr); });
        VkDescriptorSetAllocateInfo allocate{};
        allocate.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
        allocate.descriptorPool = pool;
        allocate.descriptorSetCount = 1;
        allocate.pSetLayouts = &layout;
        VkDescriptorSet set = VK_NULL_HANDLE;
        must(vkAllocateDescriptorSets(device_, &allocate, &set), "vkAllocateDescriptorSets");
        for (std::uint32_t i = 0; i < all.size(); ++i) {
            const VkDescriptorBufferInfo buffer{all[i].buffer, 0, VK_WHOLE_SIZE};
            VkWriteDescriptorSet write{};
            write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
            write.dstSet = set;
            write.dstBinding = i;
            write.descriptorCount = 1;
            write.descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
            write.pBufferInfo = &buffer;
            vkUpdateDescriptorSets(device_, 1, &write, 0, nullptr);
        }
        return set;
    }

    VkPipeline makePipeline(Owned& owned, std::span<const std::uint32_t> spirv, const char* entry,
                            VkPipelineLayout layout) {
        VkShaderModuleCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
        info.codeSize = spirv.size_bytes();
        info.pCode = spirv.data();
        VkShaderModule module = VK_NULL_HANDLE;
        must(vkCreateShaderModule(device_, &info, nullptr, &module), "vkCreateShaderModule");
        owned.add([this, module] { vkDestroyShaderModule(device_, module, nullptr); });
        VkComputePipelineCreateInfo pipeline_info{};
        pipeline_info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
        pipeline_info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
        pipeline_info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
        pipeline_info.stage.module = module;
        pipeline_info.stage.pName = entry;
        pipeline_info.layout = layout;
        VkPipeline pipeline = VK_NULL_HANDLE;
        must(vkCreateComputePipelines(device_, VK_NULL_HANDLE, 1, &pipeline_info, nullptr, &pipeline),
             "vkCreateComputePipelines");
        owned.add([this, pipeline] { vkDestroyPipeline(device_, pipeline, nullptr); });
        return pipeline;
    }

    /// A shader and its layouts.
    struct Program {
        Owned owned;
        std::vector<std::uint32_t> spirv;
        VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
        VkPipelineLayout layout = VK_NULL_HANDLE;
        VkPipeline pipeline = VK_NULL_HANDLE;
    };

    /// Returns the program of a shader. The last one is kept, because software devices take seconds to compile a
    /// shader.
    const Program& programOf(std::span<const std::uint32_t> spirv, const char* entry, std::size_t buffer_count) {
        if (program_ != nullptr &&
            std::equal(spirv.begin(), spirv.end(), program_->spirv.begin(), program_->spirv.end()))
            return *program_;
        program_ = std::make_unique<Program>();
        program_->spirv.assign(spirv.begin(), spirv.end());
        program_->set_layout = makeSetLayout(program_->owned, buffer_count);
        VkPipelineLayoutCreateInfo layout_info{};
        layout_info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
        layout_info.setLayoutCount = 1;
        layout_info.pSetLayouts = &program_->set_layout;
        must(vkCreatePipelineLayout(device_, &layout_info, nullptr, &program_->layout), "vkCreatePipelineLayout");
        program_->owned.add([this, layout = program_->layout] { vkDestroyPipelineLayout(device_, layout, nullptr); });
        program_->pipeline = makePipeline(program_->owned, spirv, entry, program_->layout);
        return *program_;
    }

    void dispatch(Owned& owned, std::span<const std::uint32_t> spirv, const char* entry,
                  std::span<const Buffer> buffers, std::uint32_t groups) {
        const Program& program = programOf(spirv, entry, buffers.size());
        VkPipelineLayout layout = program.layout;
        VkPipeline pipeline = program.pipeline;
        VkDescriptorSet set = makeSet(owned, program.set_layout, buffers);

        VkCommandPoolCreateInfo pool_info{};
        pool_info.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
        pool_info.queueFamilyIndex = family_;
        VkCommandPool pool = VK_NULL_HANDLE;
        must(vkCreateCommandPool(device_, &pool_info, nullptr, &pool), "vkCreateCommandPool");
        owned.add([this, pool] { vkDestroyCommandPool(device_, pool, nullptr); });
        VkCommandBufferAllocateInfo allocate{};
        allocate.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
        allocate.commandPool = pool;
        allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
        allocate.commandBufferCount = 1;
        VkCommandBuffer commands = VK_NULL_HANDLE;
        must(vkAllocateCommandBuffers(device_, &allocate, &commands), "vkAllocateCommandBuffers");
        VkCommandBufferBeginInfo begin{};
        begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
        must(vkBeginCommandBuffer(commands, &begin), "vkBeginCommandBuffer");
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
        vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1, &set, 0, nullptr);
        vkCmdDispatch(commands, groups, 1, 1);
        must(vkEndCommandBuffer(commands), "vkEndCommandBuffer");
        VkSubmitInfo submit{};
        submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
        submit.commandBufferCount = 1;
        submit.pCommandBuffers = &commands;
        must(vkQueueSubmit(queue_, 1, &submit, VK_NULL_HANDLE), "vkQueueSubmit");
        must(vkQueueWaitIdle(queue_), "vkQueueWaitIdle");
    }

    Owned owned_;
    std::unique_ptr<Program> program_;  ///< must be destroyed before the device
    VkInstance instance_ = VK_NULL_HANDLE;
    VkPhysicalDevice physical_ = VK_NULL_HANDLE;
    VkDevice device_ = VK_NULL_HANDLE;
    VkQueue queue_ = VK_NULL_HANDLE;
    std::uint32_t family_ = 0;
    std::string name_;
};

}  // namespace

std::unique_ptr<VulkanCompute> VulkanCompute::open(std::string& why) {
    try {
        return std::make_unique<Device>();
    } catch (const Failed& failed) {
        why = failed.what;
        return nullptr;
    }
}

}  // namespace tspace::shaders
