/* SPDX-License-Identifier: MIT */
/* Computes normals and tangents of a pose with Vulkan. A plan is made once, written as words (tspace_planBuffers) and
 * uploaded; the compute shader shaders/tspace_evaluate.glsl then computes the frames of a bent sheet. This program
 * reads them back only to compare them with the frames of the library; a renderer would bind the two buffers as vertex
 * buffers.
 *
 *   glslangValidator -V -S comp -o evaluate.spv shaders/tspace_evaluate.glsl
 *   cc examples/gpu_evaluate.c -ltspace -lvulkan -lm -o gpu_evaluate && ./gpu_evaluate evaluate.spv */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <vulkan/vulkan.h>

#include "tspace/tspace.h"

enum { QUADS = 48, SIDE = QUADS + 1, VERTICES = SIDE * SIDE, CORNERS = 6 * QUADS * QUADS };
/* Binding numbers of the shader. */
enum { PLAN, SETTINGS, POSITIONS, DEFORM, NORMALS, TANGENTS, BINDINGS };
enum { SETTING_WORDS = 32, THREADS = 64 };

static float positions[3 * VERTICES], bent[3 * VERTICES], uvs[2 * VERTICES];
static uint32_t indices[CORNERS];

static void fail(const char* what, int code) {
    fprintf(stderr, "%s failed: %d\n", what, code);
    exit(1);
}
#define VK(call)                                         \
    do {                                                 \
        const VkResult result_ = (call);                 \
        if (result_ != VK_SUCCESS) fail(#call, result_); \
    } while (0)
#define TS(call)                                                                            \
    do {                                                                                    \
        tspace_Error error = {0};                                                           \
        const tspace_ErrorCode code_ = (call);                                              \
        if (code_ != TSPACE_OK) fail(error.message[0] ? error.message : #call, (int)code_); \
    } while (0)

/* ---- the mesh: a sheet, and its pose */

static void makeSheet(void) {
    uint32_t corner = 0;
    for (uint32_t v = 0; v < VERTICES; ++v) {
        const uint32_t i = v % SIDE, j = v / SIDE;
        const float x = (float)i / QUADS, y = (float)j / QUADS;
        const float rest[3] = {x, y, 0}, pose[3] = {x, y, 0.1f * sinf(9 * x + 2 * y)};
        memcpy(positions + 3 * v, rest, sizeof rest);
        memcpy(bent + 3 * v, pose, sizeof pose);
        uvs[2 * v] = 2 * x;
        uvs[2 * v + 1] = 2 * y;
        if (i == QUADS || j == QUADS) continue;
        const uint32_t quad[6] = {v, v + 1, v + SIDE + 1, v, v + SIDE + 1, v + SIDE};
        for (int k = 0; k < 6; ++k) indices[corner++] = quad[k];
    }
}

/* ---- Vulkan: a device, buffers that this program can write, and one dispatch */

static VkInstance instance;
static VkPhysicalDevice physical;
static VkDevice device;
static VkQueue queue;
static uint32_t family;

static void openDevice(void) {
    const VkApplicationInfo application = {.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                           .apiVersion = VK_API_VERSION_1_0};
    const VkInstanceCreateInfo info = {.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                       .pApplicationInfo = &application};
    VK(vkCreateInstance(&info, NULL, &instance));
    uint32_t count = 1;
    const VkResult found = vkEnumeratePhysicalDevices(instance, &count, &physical);
    if ((found != VK_SUCCESS && found != VK_INCOMPLETE) || count == 0) fail("vkEnumeratePhysicalDevices", found);
    VkQueueFamilyProperties families[16];
    count = 16;
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families);
    while (family < count && (families[family].queueFlags & VK_QUEUE_COMPUTE_BIT) == 0) ++family;
    if (family == count) fail("a queue that computes", 0);
    const float priority = 1;
    const VkDeviceQueueCreateInfo queues = {.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                            .queueFamilyIndex = family,
                                            .queueCount = 1,
                                            .pQueuePriorities = &priority};
    const VkDeviceCreateInfo device_info = {
        .sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, .queueCreateInfoCount = 1, .pQueueCreateInfos = &queues};
    VK(vkCreateDevice(physical, &device_info, NULL, &device));
    vkGetDeviceQueue(device, family, 0, &queue);
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(physical, &properties);
    printf("device: %s\n", properties.deviceName);
}

typedef struct Buffer {
    VkBuffer buffer;
    VkDeviceMemory memory;
    void* mapped;
} Buffer;

/* Creates a storage buffer in memory that stays mapped. `data`: initial contents, or null. */
static Buffer makeBuffer(const void* data, size_t bytes) {
    Buffer made;
    const VkBufferCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = bytes, .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT};
    VK(vkCreateBuffer(device, &info, NULL, &made.buffer));
    VkMemoryRequirements needs;
    vkGetBufferMemoryRequirements(device, made.buffer, &needs);
    VkPhysicalDeviceMemoryProperties memory;
    vkGetPhysicalDeviceMemoryProperties(physical, &memory);
    const VkMemoryPropertyFlags wanted = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    uint32_t kind = 0;
    while (kind < memory.memoryTypeCount &&
           ((needs.memoryTypeBits >> kind & 1) == 0 || (memory.memoryTypes[kind].propertyFlags & wanted) != wanted))
        ++kind;
    if (kind == memory.memoryTypeCount) fail("memory that the host can write", 0);
    const VkMemoryAllocateInfo allocation = {
        .sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, .allocationSize = needs.size, .memoryTypeIndex = kind};
    VK(vkAllocateMemory(device, &allocation, NULL, &made.memory));
    VK(vkBindBufferMemory(device, made.buffer, made.memory, 0));
    VK(vkMapMemory(device, made.memory, 0, VK_WHOLE_SIZE, 0, &made.mapped));
    if (data != NULL) memcpy(made.mapped, data, bytes);
    return made;
}

static VkShaderModule loadShader(const char* path) {
    static uint32_t words[1 << 16];
    FILE* file = fopen(path, "rb");
    if (file == NULL) fail(path, 0);
    const size_t bytes = fread(words, 1, sizeof words, file);
    fclose(file);
    const VkShaderModuleCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, .codeSize = bytes, .pCode = words};
    VkShaderModule module;
    VK(vkCreateShaderModule(device, &info, NULL, &module));
    return module;
}

/* Objects that are reused in every frame. */
static VkDescriptorSetLayout set_layout;
static VkPipelineLayout layout;
static VkPipeline pipeline;
static VkShaderModule shader;
static VkDescriptorPool sets;
static VkDescriptorSet set;
static VkCommandPool commands;

static void makePipeline(const char* path) {
    VkDescriptorSetLayoutBinding bindings[BINDINGS];
    for (uint32_t i = 0; i < BINDINGS; ++i)
        bindings[i] = (VkDescriptorSetLayoutBinding){.binding = i,
                                                     .descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                                                     .descriptorCount = 1,
                                                     .stageFlags = VK_SHADER_STAGE_COMPUTE_BIT};
    const VkDescriptorSetLayoutCreateInfo set_info = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO, .bindingCount = BINDINGS, .pBindings = bindings};
    VK(vkCreateDescriptorSetLayout(device, &set_info, NULL, &set_layout));
    const VkPipelineLayoutCreateInfo layout_info = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO, .setLayoutCount = 1, .pSetLayouts = &set_layout};
    VK(vkCreatePipelineLayout(device, &layout_info, NULL, &layout));
    shader = loadShader(path);
    const VkComputePipelineCreateInfo info = {.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
                                              .stage = {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                                                        .stage = VK_SHADER_STAGE_COMPUTE_BIT,
                                                        .module = shader,
                                                        .pName = "main"},
                                              .layout = layout};
    VK(vkCreateComputePipelines(device, VK_NULL_HANDLE, 1, &info, NULL, &pipeline));
}

static void bindBuffers(const Buffer* buffers) {
    const VkDescriptorPoolSize size = {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, BINDINGS};
    const VkDescriptorPoolCreateInfo pool_info = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO, .maxSets = 1, .poolSizeCount = 1, .pPoolSizes = &size};
    VK(vkCreateDescriptorPool(device, &pool_info, NULL, &sets));
    const VkDescriptorSetAllocateInfo set_info = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                                  .descriptorPool = sets,
                                                  .descriptorSetCount = 1,
                                                  .pSetLayouts = &set_layout};
    VK(vkAllocateDescriptorSets(device, &set_info, &set));
    for (uint32_t i = 0; i < BINDINGS; ++i) {
        const VkDescriptorBufferInfo range = {buffers[i].buffer, 0, VK_WHOLE_SIZE};
        const VkWriteDescriptorSet write = {.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                            .dstSet = set,
                                            .dstBinding = i,
                                            .descriptorCount = 1,
                                            .descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                                            .pBufferInfo = &range};
        vkUpdateDescriptorSets(device, 1, &write, 0, NULL);
    }
}

/* Computes the frames of one pose on the GPU, with one thread per result. */
static void dispatch(uint32_t results) {
    const VkCommandPoolCreateInfo pool_info = {.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                               .queueFamilyIndex = family};
    VK(vkCreateCommandPool(device, &pool_info, NULL, &commands));
    const VkCommandBufferAllocateInfo allocation = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                                    .commandPool = commands,
                                                    .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                                    .commandBufferCount = 1};
    VkCommandBuffer buffer;
    VK(vkAllocateCommandBuffers(device, &allocation, &buffer));
    const VkCommandBufferBeginInfo begin = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    VK(vkBeginCommandBuffer(buffer, &begin));
    vkCmdBindPipeline(buffer, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
    vkCmdBindDescriptorSets(buffer, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1, &set, 0, NULL);
    vkCmdDispatch(buffer, (results + THREADS - 1) / THREADS, 1, 1); /* the limit in x is 65535; larger counts need y */
    /* Makes the results visible to the host; a renderer uses VERTEX_INPUT and VERTEX_ATTRIBUTE_READ. */
    const VkMemoryBarrier barrier = {.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER,
                                     .srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT,
                                     .dstAccessMask = VK_ACCESS_HOST_READ_BIT};
    vkCmdPipelineBarrier(buffer, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &barrier, 0,
                         NULL, 0, NULL);
    VK(vkEndCommandBuffer(buffer));
    const VkSubmitInfo submit = {
        .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO, .commandBufferCount = 1, .pCommandBuffers = &buffer};
    VK(vkQueueSubmit(queue, 1, &submit, VK_NULL_HANDLE));
    VK(vkQueueWaitIdle(queue));
}

static void closeDevice(const Buffer* buffers) {
    for (uint32_t i = 0; i < BINDINGS; ++i) {
        vkDestroyBuffer(device, buffers[i].buffer, NULL);
        vkFreeMemory(device, buffers[i].memory, NULL);
    }
    vkDestroyCommandPool(device, commands, NULL);
    vkDestroyDescriptorPool(device, sets, NULL);
    vkDestroyPipeline(device, pipeline, NULL);
    vkDestroyShaderModule(device, shader, NULL);
    vkDestroyPipelineLayout(device, layout, NULL);
    vkDestroyDescriptorSetLayout(device, set_layout, NULL);
    vkDestroyDevice(device, NULL);
    vkDestroyInstance(instance, NULL);
}

/* ---- comparison with the library */

/* Returns the angle between two unit vectors, in degrees. */
static double angleBetween(const float* a, const float* b) {
    const double x = a[1] * (double)b[2] - a[2] * (double)b[1], y = a[2] * (double)b[0] - a[0] * (double)b[2];
    const double z = a[0] * (double)b[1] - a[1] * (double)b[0];
    const double cosine = a[0] * (double)b[0] + a[1] * (double)b[1] + a[2] * (double)b[2];
    return atan2(sqrt(x * x + y * y + z * z), cosine) * 57.29577951308232;
}

/* Returns the largest angle between the GPU's frames and those that the library computes for the pose. */
static double largestDifference(const tspace_TangentPlan* plan, const tspace_Mesh* mesh, const float* normals,
                                const float* tangents) {
    static float expected_normals[3 * CORNERS], vertex_normals[3 * VERTICES], expected[4 * CORNERS];
    tspace_Mesh posed = *mesh;
    posed.positions.data = bent;
    TS(tspace_generateNormals(&posed, NULL, (tspace_Span){expected_normals, CORNERS, 0}, NULL, NULL, &error));
    for (int c = 0; c < CORNERS; ++c) memcpy(vertex_normals + 3 * indices[c], expected_normals + 3 * c, 12);
    tspace_Pose pose;
    TSPACE_INIT(pose);
    pose.positions = posed.positions;
    pose.normals = (tspace_ConstSpan){vertex_normals, VERTICES, 0};
    tspace_TangentOutput out;
    TSPACE_INIT(out);
    out.tangents = (tspace_Span){expected, CORNERS, 0};
    TS(tspace_evaluateTangents(plan, &pose, &out, NULL, NULL, &error));
    double worst = 0;
    for (int c = 0; c < CORNERS; ++c) {
        const uint32_t v = indices[c];
        const double n = angleBetween(expected_normals + 3 * c, normals + 3 * v);
        const double t = angleBetween(expected + 4 * c, tangents + 4 * v);
        worst = fmax(worst, fmax(n, t));
        if (expected[4 * c + 3] != tangents[4 * v + 3]) fail("a sign", c);
    }
    return worst;
}

int main(int argument_count, char** arguments) {
    if (argument_count != 2) {
        fprintf(stderr, "usage: gpu_evaluate SHADER.spv\n");
        return 2;
    }
    makeSheet();

    /* Done once: computes normals, makes a vertex for each result, and creates a plan and its words. */
    tspace_TangentOptions options;
    TSPACE_INIT(options);
    TS(tspace_findConvention("gltf", &options.convention, &error));
    tspace_Mesh mesh;
    TSPACE_INIT(mesh);
    mesh.positions = (tspace_ConstSpan){positions, VERTICES, 0};
    mesh.uvs = (tspace_ConstSpan){uvs, VERTICES, 0};
    mesh.indices = (tspace_Indices){indices, CORNERS, TSPACE_INDEX_U32};
    tspace_IndexedFramesOptions frame_options;
    TSPACE_INIT(frame_options);
    frame_options.tangents = &options;
    tspace_IndexedFrames* frames;
    TS(tspace_makeIndexedFrames(&mesh, &frame_options, NULL, &frames, &error));
    if (frames->vertex_count != VERTICES)
        fail("a sheet without seams", (int)frames->vertex_count); /* nothing to gather */
    mesh.normals = (tspace_ConstSpan){frames->normals, VERTICES, 0};
    tspace_TangentPlan* plan;
    TS(tspace_planTangents(&mesh, &options, NULL, &plan, &error));
    tspace_PlanBufferOptions buffer_options;
    TSPACE_INIT(buffer_options);
    buffer_options.source_corners = frames->source_corners;
    buffer_options.source_corner_count = frames->vertex_count;
    buffer_options.mesh = &mesh; /* the shader makes normals too */
    tspace_PlanBuffers* words;
    TS(tspace_planBuffers(plan, &buffer_options, NULL, &words, &error));

    /* Words: formats, offsets and strides (in bytes) of positions (0..5), normals (6..8) and tangents (9..11). */
    uint32_t settings[SETTING_WORDS] = {0, 0, 12};
    settings[6] = 1;
    settings[8] = 12;
    settings[11] = 16;

    openDevice();
    makePipeline(arguments[1]);
    const uint32_t none = 0;
    const Buffer buffers[BINDINGS] = {
        [PLAN] = makeBuffer(words->words, 4 * words->word_count),
        [SETTINGS] = makeBuffer(settings, sizeof settings),
        [POSITIONS] = makeBuffer(bent, sizeof bent), /* for each pose */
        [DEFORM] = makeBuffer(&none, sizeof none),
        [NORMALS] = makeBuffer(NULL, 12 * words->result_count),
        [TANGENTS] = makeBuffer(NULL, 16 * words->result_count),
    };
    bindBuffers(buffers);
    dispatch((uint32_t)words->result_count); /* for each pose */

    const double worst = largestDifference(plan, &mesh, buffers[NORMALS].mapped, buffers[TANGENTS].mapped);
    printf("%u results of %d triangles; largest difference from the library: %.6f degrees\n",
           (unsigned)words->result_count, CORNERS / 3, worst);
    closeDevice(buffers);
    tspace_destroyPlanBuffers(words);
    tspace_destroyTangentPlan(plan);
    tspace_destroyIndexedFrames(frames);
    return worst < 0.001 ? 0 : 1;
}
