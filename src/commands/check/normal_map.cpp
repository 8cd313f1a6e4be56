// SPDX-License-Identifier: MIT
// Tests the integrability of normal maps, and finds the axes of a map.
#include "commands/check/normal_map.h"

#include <algorithm>
#include <cmath>

#include "core/base/vec_math.h"

namespace tspace {
namespace {

/// Minimum z of normals that are used. Texels with steeper normals are island borders, or no normals.
constexpr float kMinUp = 0.25f;
/// Maximum derivative that is used. Larger derivatives are discontinuities between islands.
constexpr float kMaxDerivative = 0.25f;
/// Minimum mean square of a derivative in a block. Rounding to 8 bits (2.6e-6) and compression artifacts are below it.
constexpr float kMinRelief = 4e-5f;

/// Computes the slopes p and q of a texel. Returns false if its normal does not point out of the surface.
bool slopes(const std::uint8_t* texel, float& p, float& q) {
    const float nz = static_cast<float>(texel[2]) / 127.5f - 1;
    if (nz < kMinUp) return false;
    p = -(static_cast<float>(texel[0]) / 127.5f - 1) / nz;
    q = -(static_cast<float>(texel[1]) / 127.5f - 1) / nz;
    return true;
}

/// Computes the mean slopes of a square of texels. Returns false if a texel has no slope.
bool slopesOfSquare(const RgbImage& image, const TexelMask& inside, std::uint32_t left, std::uint32_t top,
                    std::uint32_t side, float& p, float& q) {
    p = q = 0;
    for (std::uint32_t y = top; y < top + side; ++y) {
        for (std::uint32_t x = left; x < left + side; ++x) {
            float own_p = 0, own_q = 0;
            const std::size_t texel = std::size_t{y} * image.width + x;
            if (!inside.has(x, y) || !slopes(image.rgb.data() + 3 * texel, own_p, own_q)) return false;
            p += own_p;
            q += own_q;
        }
    }
    p /= static_cast<float>(side * side);
    q /= static_cast<float>(side * side);
    return true;
}

/// Computes dq/dx and dp/drow from the squares around the square at (x, y), all of which must lie in the image. Returns
/// false if one of them has no slopes.
bool derivatives(const RgbImage& image, const TexelMask& inside, std::uint32_t x, std::uint32_t y, std::uint32_t side,
                 float& a, float& b) {
    for (std::uint32_t i = 0; i < side * side; ++i) {
        if (!inside.has(x + i % side, y + i / side)) return false;
    }
    float p_left, q_left, p_right, q_right, p_above, q_above, p_below, q_below;
    if (!slopesOfSquare(image, inside, x - side, y, side, p_left, q_left) ||
        !slopesOfSquare(image, inside, x + side, y, side, p_right, q_right) ||
        !slopesOfSquare(image, inside, x, y - side, side, p_above, q_above) ||
        !slopesOfSquare(image, inside, x, y + side, side, p_below, q_below)) {
        return false;
    }
    a = std::clamp(0.5f * (q_right - q_left), -kMaxDerivative, kMaxDerivative);
    b = std::clamp(0.5f * (p_below - p_above), -kMaxDerivative, kMaxDerivative);
    return true;
}

/// Votes of blocks, and their agreement.
struct Votes {
    double ab = 0, aa = 0, bb = 0;
    std::uint64_t count = 0, down_count = 0;

    void add(double block_ab, double block_aa, double block_bb) {
        ab += block_ab;
        aa += block_aa;
        bb += block_bb;
        ++count;
        down_count += block_ab > 0;
    }
    [[nodiscard]] double correlation() const { return aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : 0; }
    /// Returns +1 for down, -1 for up, 0 for undecided.
    [[nodiscard]] int side(double min_correlation, double min_agreement) const {
        if (count == 0) return 0;
        const double down = static_cast<double>(down_count) / static_cast<double>(count);
        if (correlation() > min_correlation && down >= min_agreement) return 1;
        return correlation() < -min_correlation && 1 - down >= min_agreement ? -1 : 0;
    }
};

constexpr std::uint64_t kMinBlocks = 16;
/// Thresholds for a whole map, or for the texels that one primitive covers.
constexpr double kMinCorrelation = 0.1, kMinAgreement = 0.65;
/// Thresholds for a part that contradicts another part of its map, and for averages of texels if single texels give no
/// verdict. They are strict, so that chance and unusual relief do not produce such a part.
constexpr double kPartCorrelation = 0.3, kPartAgreement = 0.8;
/// Minimum number of blocks in a part, and their minimum share of all voting blocks.
constexpr std::uint64_t kMinPartBlocks = 16;
constexpr double kMinPartShare = 0.02;

}  // namespace

double GreenTest::confidence() const {
    if (verdict == GreenVerdict::unknown || block_count == 0) return 0;
    if (verdict == GreenVerdict::mixed)
        return static_cast<double>(down_part_blocks + up_part_blocks) / static_cast<double>(block_count);
    const double down = static_cast<double>(down_block_count) / static_cast<double>(block_count);
    return std::fabs(2 * down - 1);
}

GreenBlocks::GreenBlocks(const RgbImage& image, const TexelMask& inside)
    : width_(image.width), height_(image.height), columns_((image.width + kBlock - 1) / kBlock),
      rows_((image.height + kBlock - 1) / kBlock), blocks_(measured(image, inside, 1)) {
    findParts();
    if (all().verdict == GreenVerdict::unknown) means_ = measured(image, inside, 2);
}

std::vector<GreenBlocks::Block> GreenBlocks::measured(const RgbImage& image, const TexelMask& inside,
                                                      std::uint32_t side) const {
    std::vector<Block> blocks(std::size_t{columns_} * rows_);
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        const TexelRect rect = rectOf(i);
        Block& block = blocks[i];
        std::uint32_t count = 0;
        for (std::uint32_t y = std::max(rect.top, side); y < rect.bottom && y + 2 * side <= height_; y += side) {
            for (std::uint32_t x = std::max(rect.left, side); x < rect.right && x + 2 * side <= width_; x += side) {
                float a = 0, b = 0;
                if (!derivatives(image, inside, x, y, side, a, b)) continue;
                block.ab += a * b;
                block.aa += a * a;
                block.bb += b * b;
                ++count;
            }
        }
        block.votes = 4 * side * side * count >= kBlock * kBlock &&
                      std::min(block.aa, block.bb) >= kMinRelief * static_cast<float>(count);
    }
    return blocks;
}

TexelRect GreenBlocks::rectOf(std::size_t block) const {
    const auto left = static_cast<std::uint32_t>(block % columns_) * kBlock;
    const auto top = static_cast<std::uint32_t>(block / columns_) * kBlock;
    return {left, top, std::min(left + kBlock, width_), std::min(top + kBlock, height_)};
}

/// Returns the direction of a block and its neighbors; 0 if they disagree or have too few votes.
int GreenBlocks::sideOf(std::size_t block) const {
    constexpr std::uint64_t kMinAround = 3;
    const auto column = static_cast<std::uint32_t>(block % columns_),
               row = static_cast<std::uint32_t>(block / columns_);
    Votes votes;
    for (std::uint32_t y = row == 0 ? 0 : row - 1; y < std::min(row + 2, rows_); ++y) {
        for (std::uint32_t x = column == 0 ? 0 : column - 1; x < std::min(column + 2, columns_); ++x) {
            const Block& near = blocks_[std::size_t{y} * columns_ + x];
            if (near.votes) votes.add(near.ab, near.aa, near.bb);
        }
    }
    return votes.count < kMinAround ? 0 : votes.side(kPartCorrelation, 0.5);
}

/// Groups adjacent blocks with equal directions into parts. A group with few blocks, or whose blocks disagree too much,
/// is not a part.
void GreenBlocks::findParts() {
    const auto voting = static_cast<double>(
        std::count_if(blocks_.begin(), blocks_.end(), [](const Block& block) { return block.votes; }));
    std::vector<int> sides(blocks_.size());
    for (std::size_t i = 0; i < blocks_.size(); ++i) sides[i] = blocks_[i].votes ? sideOf(i) : 0;
    std::vector<std::size_t> part;
    for (std::size_t start = 0; start < blocks_.size(); ++start) {
        const int side = sides[start];
        if (side == 0) continue;
        Votes votes;
        part.assign(1, start);
        sides[start] = 0;
        for (std::size_t next = 0; next < part.size(); ++next) {
            const std::size_t at = part[next], column = at % columns_;
            votes.add(blocks_[at].ab, blocks_[at].aa, blocks_[at].bb);
            const auto reach = [&](bool exists, std::size_t neighbor) {
                if (!exists || sides[neighbor] != side) return;
                sides[neighbor] = 0;
                part.push_back(neighbor);
            };
            reach(column > 0, at - 1);
            reach(column + 1 < columns_, at + 1);
            reach(at >= columns_, at - columns_);
            reach(at + columns_ < blocks_.size(), at + columns_);
        }
        if (part.size() < kMinPartBlocks || static_cast<double>(part.size()) < kMinPartShare * voting ||
            votes.side(kPartCorrelation, kPartAgreement) != side) {
            continue;
        }
        ++part_count_;
        for (const std::size_t block : part) {
            blocks_[block].side = static_cast<std::int8_t>(side);
            blocks_[block].part = part_count_;
        }
    }
}

template <class IsChosen>
GreenTest GreenBlocks::judge(const IsChosen& isChosen) const {
    GreenTest test;
    Votes all;
    std::vector<std::uint64_t> sizes(part_count_ + 1);
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
        const Block& block = blocks_[i];
        if (!block.votes || !isChosen(i)) continue;
        all.add(block.ab, block.aa, block.bb);
        ++sizes[block.part];
    }
    test.block_count = all.count;
    test.down_block_count = all.down_count;
    test.correlation = all.correlation();
    std::uint32_t down_part = 0, up_part = 0;  // numbers of the largest parts with green down and up; 0: none
    sizes[0] = 0;
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
        const Block& block = blocks_[i];
        if (block.part == 0 || sizes[block.part] < kMinPartBlocks) continue;
        std::uint32_t& largest = block.side > 0 ? down_part : up_part;
        if (sizes[block.part] > sizes[largest]) largest = block.part;
    }
    if (down_part != 0 && up_part != 0) {
        test.verdict = GreenVerdict::mixed;
        test.down_part_blocks = sizes[down_part];
        test.up_part_blocks = sizes[up_part];
        for (std::size_t i = 0; i < blocks_.size(); ++i) {
            if (!isChosen(i)) continue;
            if (blocks_[i].part == down_part) test.down_part.include(rectOf(i));
            if (blocks_[i].part == up_part) test.up_part.include(rectOf(i));
        }
    } else if (all.count >= kMinBlocks) {
        int side = all.side(kMinCorrelation, kMinAgreement);
        if (side == 0) side = sideOfMeans(isChosen, test);
        if (side > 0 && up_part == 0) test.verdict = GreenVerdict::down;
        if (side < 0 && down_part == 0) test.verdict = GreenVerdict::up;
    }
    return test;
}

/// Decides with the averages of 2 x 2 texels, which compression and noise affect less than single texels. Returns +1
/// for down, -1 for up, and 0 if undecided or if the single texels lean to the other side. If decided, `test` receives
/// the votes of the averages.
template <class IsChosen>
int GreenBlocks::sideOfMeans(const IsChosen& isChosen, GreenTest& test) const {
    Votes votes;
    for (std::size_t i = 0; i < means_.size(); ++i) {
        if (means_[i].votes && isChosen(i)) votes.add(means_[i].ab, means_[i].aa, means_[i].bb);
    }
    const int side = votes.count < kMinBlocks ? 0 : votes.side(kPartCorrelation, kPartAgreement);
    if (side == 0 || (side > 0) != (test.correlation > 0)) return 0;
    test.block_count = votes.count;
    test.down_block_count = votes.down_count;
    test.correlation = votes.correlation();
    return side;
}

GreenTest GreenBlocks::all() const {
    return judge([](std::size_t) { return true; });
}

GreenTest GreenBlocks::within(const TexelMask& part) const {
    GreenTest test = judge([&](std::size_t i) {
        const TexelRect rect = rectOf(i);
        return 4 * part.count(rect) >= kBlock * kBlock;
    });
    if (test.verdict != GreenVerdict::unknown || test.block_count >= kMinBlocks) return test;
    const GreenVerdict whole = all().verdict;
    if (whole == GreenVerdict::up || whole == GreenVerdict::down) test.verdict = whole;
    return test;
}

double bestAgreement(const Moments& moments) {
    // Eigenvalues of the symmetric matrix S = M^T M, as roots of its characteristic polynomial (Smith 1961).
    std::array<std::array<double, 3>, 3> s{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            for (const auto& row : moments.sum) s[i][k] += row[i] * row[k] / moments.weight / moments.weight;
        }
    }
    const double mean = (s[0][0] + s[1][1] + s[2][2]) / 3;
    for (std::size_t i = 0; i < 3; ++i) s[i][i] -= mean;
    double squares = 0;
    for (const auto& row : s) squares += row[0] * row[0] + row[1] * row[1] + row[2] * row[2];
    const double p = std::sqrt(squares / 6);
    const double det = s[0][0] * (s[1][1] * s[2][2] - s[1][2] * s[2][1]) -
                       s[0][1] * (s[1][0] * s[2][2] - s[1][2] * s[2][0]) +
                       s[0][2] * (s[1][0] * s[2][1] - s[1][1] * s[2][0]);
    const double angle = p > 0 ? std::acos(std::clamp(det / (2 * p * p * p), -1.0, 1.0)) / 3 : 0;
    double sum = 0;
    for (int k = 0; k < 3; ++k) sum += std::sqrt(std::max(0.0, mean + 2 * p * std::cos(angle + k * 2 * kPi / 3)));
    return sum;
}

Axes bestAxes(const Moments& moments) {
    constexpr std::array<std::array<std::size_t, 3>, 6> kOrders{
        {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
    Axes best;
    for (const auto& order : kOrders) {
        double agreement = 0;
        std::array<MapComponent, 3> components;
        for (std::size_t i = 0; i < 3; ++i) {
            const double part = moments.sum[i][order[i]];
            agreement += std::fabs(part) / moments.weight;
            components[i] = {static_cast<MapChannel>(order[i]), part < 0};
        }
        if (agreement > best.agreement + 1e-9)
            best = {{.x = components[0], .y = components[1], .z = components[2]}, agreement};
    }
    return best;
}

}  // namespace tspace
