// SPDX-License-Identifier: MIT
// Based on: the SPIR-V specification 1.6, section 3, and its extended instructions for GLSL.
#include "operation_counts.h"

#include <vector>

namespace tspace::shaders {

namespace {

enum Op : std::uint32_t {
    kName = 5,
    kExtInst = 12,
    kTypeInt = 21,
    kTypeFloat = 22,
    kTypeVector = 23,
    kTypeMatrix = 24,
    kFunction = 54,
    kFunctionEnd = 56,
    kFunctionCall = 57,
    kStore = 62,
    kConvertFToU = 109,
    kBitcast = 124,
    kSNegate = 126,
    kUDiv = 134,
    kSDiv = 135,
    kFDiv = 136,
    kVectorTimesScalar = 142,
    kMatrixTimesScalar = 143,
    kDot = 148,
    kSelect = 169,
    kNot = 200,
    kLabel = 248,
    kBranchConditional = 250,
};
enum Extended : std::uint32_t {
    kInverseSqrt = 32,
    kSqrt = 31,
    kSin = 13,
    kCos = 14,
    kFMix = 46,
    kCross = 68,
    kNormalize = 69,
};

struct Function {
    std::string name;
    OperationCount own;
    std::vector<std::uint32_t> calls;
};

class Counter {
  public:
    explicit Counter(std::span<const std::uint32_t> spirv) {
        constexpr std::size_t kHeader = 5;
        for (std::size_t at = kHeader; at < spirv.size();) {
            const std::size_t length = spirv[at] >> 16;
            if (length == 0 || length > spirv.size() - at) return;
            read(spirv[at] & 0xffff, spirv.subspan(at + 1, length - 1));
            at += length;
        }
    }

    [[nodiscard]] std::map<std::string, OperationCount> named() const {
        std::map<std::string, OperationCount> counts;
        for (const auto& [id, function] : functions_) {
            counts[function.name.substr(0, function.name.find('('))] = total(id);
        }
        return counts;
    }

  private:
    void read(std::uint32_t op, std::span<const std::uint32_t> in) {
        switch (op) {
            case kName: names_[in[0]] = reinterpret_cast<const char*>(&in[1]); return;
            case kTypeInt:
            case kTypeFloat: components_[in[0]] = 1; return;
            case kTypeVector:
            case kTypeMatrix: components_[in[0]] = components_[in[1]] * in[2]; return;
            case kFunction:
                current_ = in[1];
                functions_[current_].name = names_[current_];
                return;
            case kFunctionCall: functions_[current_].calls.push_back(in[2]); break;
            case kLabel: is_in_choice_ = choices_.count(in[0]) != 0; return;
            case kBranchConditional: choices_[in[1]] = true; return;
            case kStore:
                // A store on one side of ?: is counted, but only once, because both sides belong to the same selection.
                if (is_in_choice_) functions_[current_].own.operations += sizeOf(in[1]);
                is_in_choice_ = false;
                return;
            default: break;
        }
        if (in.size() < 2) return;
        types_[in[1]] = in[0];  // correct for most instructions that have a result
        if (current_ != 0) count(op, in, functions_[current_].own);
    }

    void count(std::uint32_t op, std::span<const std::uint32_t> in, OperationCount& to) {
        const unsigned size = components_.count(in[0]) != 0 ? components_[in[0]] : 1;
        if (op == kExtInst) return countExtended(in[3], size, to);
        if (op == kDot) {
            to.operations += 2 * sizeOf(in[2]) - 1;
        } else if (op == kFDiv) {
            to.divisions += size;
        } else if (op == kUDiv || op == kSDiv) {
            to.operations += 2 * size;
        } else if ((op >= kConvertFToU && op < kBitcast) || (op >= kSNegate && op <= kMatrixTimesScalar) ||
                   (op > kDot && op <= kNot)) {
            to.operations += size;
        }
    }

    static void countExtended(std::uint32_t which, unsigned size, OperationCount& to) {
        switch (which) {
            case kInverseSqrt:
            case kSqrt: to.roots += size; return;
            case kSin:
            case kCos: to.sines += size; return;
            case kFMix: to.operations += 3 * size; return;
            case kCross: to.operations += 9; return;
            case kNormalize:
                to.operations += 3 * size - 1;
                ++to.roots;
                return;
            default: to.operations += size; return;  // such as absolute value, minimum and maximum
        }
    }

    [[nodiscard]] unsigned sizeOf(std::uint32_t id) {
        const auto type = types_.find(id);
        if (type == types_.end()) return 1;
        const auto size = components_.find(type->second);
        return size == components_.end() ? 1 : size->second;
    }

    [[nodiscard]] OperationCount total(std::uint32_t id) const {
        const Function& function = functions_.at(id);
        OperationCount sum = function.own;
        for (const std::uint32_t called : function.calls) {  // ends, because shaders have no recursion
            const OperationCount more = total(called);
            sum.operations += more.operations;
            sum.roots += more.roots;
            sum.divisions += more.divisions;
            sum.sines += more.sines;
        }
        return sum;
    }

    std::map<std::uint32_t, std::string> names_;
    std::map<std::uint32_t, std::uint32_t> components_, types_;  // components of each type, and type of each value
    std::map<std::uint32_t, Function> functions_;
    std::map<std::uint32_t, bool> choices_;
    std::uint32_t current_ = 0;
    bool is_in_choice_ = false;
};

}  // namespace

std::string OperationCount::text() const {
    std::string all = std::to_string(operations) + " operations";
    if (roots != 0) all += ", " + std::to_string(roots) + (roots == 1 ? " root" : " roots");
    if (divisions != 0) all += ", " + std::to_string(divisions) + (divisions == 1 ? " division" : " divisions");
    if (sines != 0) all += ", " + std::to_string(sines) + " sines and cosines";
    return all;
}

std::map<std::string, OperationCount> countOperations(std::span<const std::uint32_t> spirv) {
    return Counter(spirv).named();
}

}  // namespace tspace::shaders
