// SPDX-License-Identifier: MIT
#include "maps/solve/solve_texels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numeric>

#include "core/base/vec_math.h"
#include "maps/texels/eight_lanes.h"

namespace tspace {
namespace {

void addBlock(SymmetricBlock& to, float weight, const SymmetricBlock& metric) {
    for (std::size_t i = 0; i < to.size(); ++i) to[i] += weight * metric[i];
}

}  // namespace

TexelSystem::TexelSystem(const Allocator* allocator, std::uint32_t width, std::uint32_t height,
                         std::span<const TexelRole> roles)
    : width_(width), height_(height), row_of_(allocator, roles.size(), 0U) {
    std::uint32_t count = 1;
    for (std::size_t i = 0; i < roles.size(); ++i) {
        if (roles[i] != TexelRole::excluded) row_of_[i] = count++;
    }
    texel_of_ = Buffer<std::uint32_t>(allocator, count, 0U);
    is_unknown_ = Buffer<bool>(allocator, count, false);
    rows_ = Buffer<TexelRow>(allocator, count, TexelRow{});
    for (std::size_t i = 0; i < roles.size(); ++i) {
        if (row_of_[i] == 0) continue;
        texel_of_[row_of_[i]] = static_cast<std::uint32_t>(i);
        is_unknown_[row_of_[i]] = roles[i] == TexelRole::unknown;
    }
}

void TexelSystem::add(std::uint32_t x, std::uint32_t y, float fx, float fy, const FitSample& sample) {
    const std::uint32_t right_x = right(x), below_y = below(y);
    const std::uint32_t at00 = rowOf(x, y), at10 = rowOf(right_x, y), at01 = rowOf(x, below_y),
                        at11 = rowOf(right_x, below_y);
    if (at00 == 0 || (fx > 0 && at10 == 0) || (fy > 0 && (at01 == 0 || (fx > 0 && at11 == 0)))) return;
    const float w00 = (1 - fx) * (1 - fy), w10 = fx * (1 - fy), w01 = (1 - fx) * fy, w11 = fx * fy;
    TexelRow &t00 = rows_[at00], &t10 = rows_[at10], &t01 = rows_[at01], &t11 = rows_[at11];
    addBlock(t00.blocks[0], w00 * w00, sample.metric);
    t00.side = t00.side + w00 * sample.side;
    if (fx > 0) {
        addBlock(t00.blocks[1], w00 * w10, sample.metric);
        addBlock(t10.blocks[0], w10 * w10, sample.metric);
        t10.side = t10.side + w10 * sample.side;
    }
    if (!(fy > 0)) return;
    addBlock(t00.blocks[3], w00 * w01, sample.metric);
    addBlock(t01.blocks[0], w01 * w01, sample.metric);
    t01.side = t01.side + w01 * sample.side;
    if (!(fx > 0)) return;
    addBlock(t00.blocks[4], w00 * w11, sample.metric);
    addBlock(t10.blocks[2], w10 * w01, sample.metric);
    addBlock(t10.blocks[3], w10 * w11, sample.metric);
    addBlock(t01.blocks[1], w01 * w11, sample.metric);
    addBlock(t11.blocks[0], w11 * w11, sample.metric);
    t11.side = t11.side + w11 * sample.side;
}

FitSample acrossSample(const Vec3& wanted, float along, float wanted_length) {
    const float less = 1 - along;
    const Vec3& v = wanted;
    return {{1 - less * v.x * v.x, -less * v.x * v.y, -less * v.x * v.z, 1 - less * v.y * v.y, -less * v.y * v.z,
             1 - less * v.z * v.z},
            (along * wanted_length) * v};
}

FitSample twoChannelSample(const Vec3& wanted) {
    // The derivative of z with respect to x and y is unbounded at grazing angles, so it is clamped.
    const float z = std::max(wanted.z, 0.1f), x = wanted.x / z, y = wanted.y / z;
    const SymmetricBlock metric{1 + x * x, x * y, 0, 1 + y * y, 0, 0};
    return {metric, blockTimes(metric, wanted)};
}

namespace {

/// Number of rows per task. The sums of tasks are added in order, so the result does not depend on the number of
/// threads.
constexpr std::size_t kSystemRows = 2048;

/// Returns the inverse of a texel's diagonal block, for preconditioning.
SymmetricBlock inverseOf(SymmetricBlock m) {
    m[0] += kHold;
    m[3] += kHold;
    m[5] += kHold;
    const float xx = m[3] * m[5] - m[4] * m[4], xy = m[2] * m[4] - m[1] * m[5], xz = m[1] * m[4] - m[2] * m[3];
    const float factor = 1 / (m[0] * xx + m[1] * xy + m[2] * xz);
    return {factor * xx,
            factor * xy,
            factor * xz,
            factor * (m[0] * m[5] - m[2] * m[2]),
            factor * (m[1] * m[2] - m[0] * m[4]),
            factor * (m[0] * m[3] - m[1] * m[1])};
}

/// Solves for the changes of the texels by conjugate gradients. The changes are small enough for floats.
class Gradients {
  public:
    Gradients(const TexelSystem& system, std::span<Vec3> texels, Parallel& parallel, const Allocator* allocator)
        : system_(system), texels_(texels), parallel_(parallel), residual_(allocator, system.rowCount(), Vec3{}),
          direction_(allocator, system.rowCount(), Vec3{}), image_(allocator, system.rowCount(), Vec3{}),
          inverse_(allocator, system.rowCount()), tasks_((system.rowCount() + kSystemRows - 1) / kSystemRows),
          first_(allocator, tasks_, 0.0), second_(allocator, tasks_, 0.0) {}

    void run(const StepCallback& report_step) {
        // Each step halves the error, approximately. After the last step the error is below the precision of 16 bits.
        constexpr int kMostSteps = 24;
        constexpr double kSmall = 1e-4;
        begin();
        double product = total(first_);
        const double enough = kSmall * product;
        for (int step = 0; step < kMostSteps && product > enough; ++step) {
            if (report_step) report_step(static_cast<std::uint64_t>(step), kMostSteps);
            multiply();
            const double curvature = total(first_);
            if (!(curvature > 0)) return;
            advance(static_cast<float>(product / curvature));
            const double next = total(second_);
            turn(static_cast<float>(next / product));
            product = next;
        }
    }

  private:
    /// Sets sums[task] to the sum of body(row) over the unknown rows of each task.
    template <class Body>
    void forUnknowns(Buffer<double>& sums, const Body& body) {
        parallel_.forTasks(tasks_, [&](std::size_t task) {
            double sum = 0;
            const std::size_t end = std::min((task + 1) * kSystemRows, system_.rowCount());
            for (std::size_t row = task * kSystemRows; row < end; ++row) {
                if (system_.isUnknown(row)) sum += body(row);
            }
            sums[task] = sum;
        });
    }

    /// Returns the sum of the products of the neighbors' blocks with their values, which `of(row, texel)` returns.
    template <class Of>
    Vec3 around(std::size_t row, const Of& of) const {
        const std::uint32_t texel = system_.texelOf(row);
        return system_.aroundTexel(texel % system_.width(), texel / system_.width(),
                                   [&](std::uint32_t x, std::uint32_t y) {
                                       return of(system_.rowOf(x, y), std::size_t{y} * system_.width() + x);
                                   });
    }

    static double total(const Buffer<double>& sums) { return std::accumulate(sums.begin(), sums.end(), 0.0); }
    static double product(const Vec3& a, const Vec3& b) { return static_cast<double>(dot(a, b)); }

    void begin() {
        forUnknowns(first_, [&](std::size_t row) {
            const TexelRow& own = system_.row(row);
            residual_[row] = own.side - blockTimes(own.blocks[0], texels_[system_.texelOf(row)]) -
                             around(row, [&](std::size_t, std::size_t texel) { return texels_[texel]; });
            inverse_[row] = inverseOf(own.blocks[0]);
            direction_[row] = blockTimes(inverse_[row], residual_[row]);
            return product(residual_[row], direction_[row]);
        });
    }

    /// Computes image = system * direction.
    void multiply() {
        forUnknowns(first_, [&](std::size_t row) {
            const Vec3& own = direction_[row];
            image_[row] = blockTimes(system_.row(row).blocks[0], own) + kHold * own +
                          around(row, [&](std::size_t other, std::size_t) { return direction_[other]; });
            return product(own, image_[row]);
        });
    }

    void advance(float length) {
        forUnknowns(second_, [&](std::size_t row) {
            Vec3& texel = texels_[system_.texelOf(row)];
            texel = texel + length * direction_[row];
            residual_[row] = residual_[row] - length * image_[row];
            image_[row] = blockTimes(inverse_[row], residual_[row]);
            return product(residual_[row], image_[row]);
        });
    }

    void turn(float kept) {
        parallel_.forRanges(system_.rowCount(), kSystemRows, [&](std::size_t begin, std::size_t end) {
            for (std::size_t row = begin; row < end; ++row) direction_[row] = image_[row] + kept * direction_[row];
        });
    }

    const TexelSystem& system_;
    std::span<Vec3> texels_;
    Parallel& parallel_;
    Buffer<Vec3> residual_, direction_, image_;
    /// Inverse of the diagonal block of each row, which is stored because recomputing it would take longer.
    Buffer<SymmetricBlock> inverse_;
    std::size_t tasks_;
    Buffer<double> first_, second_;  ///< sums of the tasks
};

}  // namespace

void solveLeastSquares(const TexelSystem& system, std::span<Vec3> texels, Parallel& parallel,
                       const Allocator* allocator, const StepCallback& report_step) {
    Gradients(system, texels, parallel, allocator).run(report_step);
}

void solveTexels(const TexelSystem& system, std::span<Vec3> texels, Parallel& parallel, const Allocator* allocator,
                 const StepCallback& report_step) {
    solveLeastSquares(system, texels, parallel, allocator, report_step);
    parallel.forRanges(texels.size(), Parallel::kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const float size = length(texels[i]);
            if (size > 1) texels[i] = (1 / size) * texels[i];
        }
    });
}

namespace {

/// Search for the integers of one texel: for the vector q that minimizes q.Mq + 2 q.h.
class IntegerTexel {
  public:
    IntegerTexel(const IntegerChoice& choice, const SymmetricBlock& m, const Vec3& h)
        : choice_(choice), step_(2.0f / static_cast<float>(choice.most)), half_(static_cast<float>(choice.most) / 2),
          last_(static_cast<float>(choice.most)), m_(m), h_(h) {
        // For a given z, the optimal real x and y lie on a line.
        const float factor = 1 / (m[0] * m[3] - m[1] * m[1]);
        start_x_ = factor * (m[1] * h.y - m[3] * h.x);
        slope_x_ = factor * (m[1] * m[4] - m[3] * m[2]);
        start_y_ = factor * (m[1] * h.x - m[0] * h.y);
        slope_y_ = factor * (m[1] * m[2] - m[0] * m[4]);
    }

    Vec3 best(const Vec3& start) const { return choice_.is_two_channel ? bestOfTwo(start) : bestOfThree(start); }

  private:
    /// Assumed contribution of the surrounding texels to the squared length of the filtered vector, relative to a texel
    /// of unit length.
    static constexpr float kOthers = 0.4F;

    [[nodiscard]] int indexOf(float value) const { return static_cast<int>(std::floor((value + 1) / step_ + 0.5f)); }
    [[nodiscard]] bool isInside(float real) const { return real >= -1 && real <= 1; }
    /// Returns the increase of the error form if x and y deviate by dx and dy from the optimal real numbers.
    [[nodiscard]] float added(float dx, float dy) const { return dx * (m_[0] * dx + 2 * m_[1] * dy) + m_[3] * dy * dy; }

    /// Quantized x and y for a given quantized z, with their distances from the real-valued optimum, all in
    /// quantization steps. x is rounded to the nearest integer; y minimizes the error for that x.
    struct PlanarIntegers {
        Eight x, y, error_x, error_y;
    };
    [[nodiscard]] PlanarIntegers nearestInPlane(const Eight& z) const {
        const auto nearest = [&](const Eight& real) { return whole(between(real + 0.5F, 0.0F, last_)); };
        const Eight real_x = Eight((start_x_ - slope_x_ + 1) * half_) + Eight(slope_x_) * z,
                    real_y = Eight((start_y_ - slope_y_ + 1) * half_) + Eight(slope_y_) * z;
        PlanarIntegers found;
        found.x = nearest(real_x);
        found.error_x = found.x - real_x;
        found.y = nearest(real_y - Eight(m_[1] / m_[3]) * found.error_x);
        found.error_y = found.y - real_y;
        return found;
    }

    [[nodiscard]] Vec3 bestOfThree(const Vec3& start) const {
        // The error form is known only up to a constant that depends on the neighbors, so its minimum over real numbers
        // is unknown. A small squared error is assumed instead: kLeftOver / 4 times the squared filter weight of the
        // texel, summed over its samples (m_[0] + m_[3] + m_[5] is twice the sum of these squares).
        constexpr float kLeftOver = 2e-6F;
        const float x = start_x_ + slope_x_ * start.z, y = start_y_ + slope_y_ * start.z;
        const float linear = 2 * (m_[2] * x + m_[4] * y + m_[5] * start.z + h_.z);
        const float square = m_[2] * slope_x_ + m_[4] * slope_y_ + m_[5];
        const float rest =
            kLeftOver * (m_[0] + m_[3] + m_[5]) / 8 + (square > 0 ? linear * linear / (4 * square) : 0.0F);
        // Range of z, with a margin of one step, of vectors that have the direction of `start` and a length within the
        // limits.
        const float size = std::max(length(start), 1e-6F), slope = start.z / size;
        const float a = slope * choice_.least_length, b = slope * choice_.most_length;
        const int first = std::max(0, indexOf(std::min(a, b)) - 1);
        const int last = std::min(static_cast<int>(choice_.most), indexOf(std::max(a, b)) + 1);

        // From here on, lengths are in steps, and squared lengths in squared steps.
        const float squares = half_ * half_, start_z = (start.z + 1) * half_;
        const Eight least_square = choice_.least_length * choice_.least_length * squares,
                    most_square = choice_.most_length * choice_.most_length * squares;
        Eight z, least = 1e6F, chosen = -1;
        for (std::size_t lane = 0; lane < 8; ++lane) z.set(lane, static_cast<float>(first + static_cast<int>(lane)));
        for (int i = first; i <= last; i += 8, z = z + 8) {
            const PlanarIntegers at = nearestInPlane(z);
            const Eight moved = z - start_z;
            const Eight value = rest * squares + moved * (linear * half_ + moved * square);
            const Eight error =
                at.error_x * (m_[0] * at.error_x + 2 * m_[1] * at.error_y) + m_[3] * (at.error_y * at.error_y);
            const Eight column = at.x - half_, row = at.y - half_, plane = z - half_;
            const Eight squared = column * column + row * row + plane * plane;
            // The score is the error as an angle: relative to the length of the filtered vector, to which the texel and
            // its neighbors contribute.
            Eight score = (value + error) / (squared + kOthers * squares);
            score = whereLess(squared, least_square, 1e20F, score);
            score = whereLess(most_square, squared, 1e20F, score);
            score = whereLess(last_, z, 1e20F, score);
            chosen = whereLess(score, least, z, chosen);
            least = smaller(score, least);
        }
        return vectorOf(least, chosen, start);
    }

    /// Returns the vector with the lowest score (if scores are equal, the one with the lowest z), or `start` if no
    /// vector is allowed.
    [[nodiscard]] Vec3 vectorOf(const Eight& scores, const Eight& planes, const Vec3& start) const {
        float least = 1e6F, z = -1;
        for (std::size_t lane = 0; lane < 8; ++lane) {
            if (!(scores[lane] < least || (scores[lane] == least && planes[lane] < z))) continue;
            least = scores[lane];
            z = planes[lane];
        }
        if (z < 0) return start;
        const PlanarIntegers at = nearestInPlane(Eight(z));
        return {at.x[0] * step_ - 1, at.y[0] * step_ - 1, z * step_ - 1};
    }

    /// Returns the best vector of a two-channel map: z follows from x and y, so only errors of x and y count.
    [[nodiscard]] Vec3 bestOfTwo(const Vec3& start) const {
        const float x = start_x_ + slope_x_ * start.z, y = start_y_ + slope_y_ * start.z;
        if (!isInside(x) || !isInside(y)) return start;
        // Returns the integer below a real number, limited so that the next integer is also valid.
        const auto below = [&](float real) {
            const auto index = static_cast<float>(static_cast<int>((real + 1) * half_));
            return std::max(0.0F, std::min(index, last_ - 1)) * step_ - 1;
        };
        Vec3 best = start;
        float least = INFINITY;
        for (int corner = 0; corner < 4; ++corner) {
            const float column = below(x) + (corner % 2 == 0 ? 0 : step_), row = below(y) + (corner < 2 ? 0 : step_);
            const float flat = column * column + row * row, score = added(column - x, row - y);
            if (flat > 1 || !(score < least)) continue;
            least = score;
            best = {column, row, std::sqrt(1 - flat)};
        }
        return best;
    }

    const IntegerChoice& choice_;
    float step_, half_, last_;
    SymmetricBlock m_;
    Vec3 h_;
    float start_x_ = 0, slope_x_ = 0, start_y_ = 0, slope_y_ = 0;
};

/// Returns the length that texels are assumed to have before they are chosen.
float typicalLength(const IntegerChoice& choice) { return (choice.least_length + choice.most_length) / 2; }

bool keepsLength(const IntegerChoice& choice, const Vec3& wanted) {
    // Tolerance for unit vectors, whose length may differ from 1 because their components are rounded.
    constexpr float kSlack = 1e-5F;
    return choice.keeps_lengths && std::fabs(length(wanted) - 1) > kSlack;
}

/// Chooses the integers of a texel: tries each z with the best x and y for it. If x or y is the longest component, the
/// axes are permuted first, so that it takes the place of z.
Vec3 bestIntegers(IntegerChoice choice, const SymmetricBlock& m, const Vec3& h, Vec3 wanted) {
    if (keepsLength(choice, wanted)) {
        const float size = length(wanted);
        choice.least_length = std::max(0.95F * size, std::min(choice.least_length, size));
        choice.most_length = std::min(1.05F * size, std::max(choice.most_length, size));
    } else if (!choice.is_two_channel) {
        wanted = typicalLength(choice) * wanted;
    }
    const float x = std::fabs(wanted.x), y = std::fabs(wanted.y), z = std::fabs(wanted.z);
    if (choice.is_two_channel || (z >= x && z >= y)) return IntegerTexel(choice, m, h).best(wanted);
    if (x > y) {
        const Vec3 best = IntegerTexel(choice, {m[3], m[4], m[1], m[5], m[2], m[0]}, {h.y, h.z, h.x})
                              .best({wanted.y, wanted.z, wanted.x});
        return {best.z, best.x, best.y};
    }
    const Vec3 best = IntegerTexel(choice, {m[5], m[2], m[4], m[0], m[1], m[3]}, {h.z, h.x, h.y})
                          .best({wanted.z, wanted.x, wanted.y});
    return {best.y, best.z, best.x};
}

/// Returns the integers for a texel whose system row has the diagonal block `own`; `rest` is the contribution of its
/// neighbors. If no sample constrains the texel, a weak pull to its own direction decides.
Vec3 chosenFor(const IntegerChoice& choice, const SymmetricBlock& own, const Vec3& rest, const Vec3& wanted) {
    DVec3 unit_wanted = toDouble(wanted);
    if (!normalize(unit_wanted)) return wanted;
    const FitSample hold = choice.is_two_channel ? twoChannelSample(toFloat(unit_wanted))
                                                 : acrossSample(toFloat(unit_wanted), 1e-6F, 0.95F);
    SymmetricBlock block = own;
    for (std::size_t i = 0; i < block.size(); ++i) block[i] += kHold * hold.metric[i];
    return bestIntegers(choice, block, rest - kHold * hold.side, wanted);
}

/// Chooses the integers of texels that are not in the system, independently of each other. Most of them are background
/// texels with equal values, so the last result is reused.
void chooseIndependently(const TexelSystem& system, const IntegerChoice& choice, std::span<Vec3> texels,
                         Parallel& parallel) {
    parallel.forRanges(system.height(), 4, [&](std::size_t begin, std::size_t end) {
        Vec3 last_wanted{}, last_chosen{};
        for (std::size_t at = begin * system.width(); at < end * system.width(); ++at) {
            if (system.rowOf(at) != 0) continue;
            if (!(texels[at] == last_wanted)) {
                last_wanted = texels[at];
                last_chosen = chosenFor(choice, {}, {}, last_wanted);
            }
            texels[at] = last_chosen;
        }
    });
}

}  // namespace

void chooseIntegers(const TexelSystem& system, const IntegerChoice& choice, std::span<Vec3> texels, unsigned rounds,
                    Parallel& parallel, const Allocator* allocator, const StepCallback& report_step) {
    const std::uint32_t width = system.width(), height = system.height();
    chooseIndependently(system, choice, texels, parallel);
    Buffer<Vec3> wanted(allocator, texels.size());
    std::copy(texels.begin(), texels.end(), wanted.begin());
    // Texels that are not chosen yet are assumed to have the usual length.
    if (!choice.is_two_channel) {
        for (std::size_t i = 0; i < texels.size(); ++i) {
            if (!system.isUnknown(system.rowOf(i)) || keepsLength(choice, texels[i])) continue;
            texels[i] = typicalLength(choice) * texels[i];
        }
    }
    const auto chooseRow = [&](std::uint32_t y) {
        for (std::uint32_t x = 0; x < width; ++x) {
            const std::size_t at = std::size_t{y} * width + x;
            const std::uint32_t number = system.rowOf(at);
            if (!system.isUnknown(number)) continue;
            const TexelRow& row = system.row(number);
            const Vec3 around = system.aroundTexel(x, y, [&](std::uint32_t column, std::uint32_t line) {
                return texels[std::size_t{line} * width + column];
            });
            texels[at] = chosenFor(choice, row.blocks[0], around - row.side, wanted[at]);
        }
    };
    for (unsigned round = 0; round < rounds; ++round) {
        const StepCallback report_row = [&](std::uint64_t done, std::uint64_t total) {
            report_step(round * total + done, rounds * total);
        };
        forNonAdjacentRows(parallel, height, chooseRow, report_step ? report_row : StepCallback());
    }
}

namespace {

/// Rounds a texel to integers. Vectors are in quantization steps, relative to the middle of the integer range. If the
/// number of integers is even, representable components are integers plus one half.
class StepRounding {
  public:
    explicit StepRounding(const TexelRounding& rounding)
        : middle_(static_cast<float>(rounding.most) / 2), last_(static_cast<float>(rounding.most)) {}

    [[nodiscard]] float middle() const { return middle_; }

    [[nodiscard]] Vec3 nearest(const Vec3& v) const { return {nearest(v.x), nearest(v.y), nearest(v.z)}; }

    /// Returns the representable vector near `wanted` that has the smallest error perpendicular to it. Its length may
    /// differ slightly.
    [[nodiscard]] Vec3 nearestAcross(const Vec3& wanted) const {
        std::array<float, 3> v{wanted.x, wanted.y, wanted.z};
        std::size_t main = 0;
        for (std::size_t i = 1; i < 3; ++i) {
            if (std::fabs(v[i]) > std::fabs(v[main])) main = i;
        }
        const std::size_t second = (main + 1) % 3, third = (main + 2) % 3;
        const float sign = v[main] < 0 ? -1.0F : 1.0F, size = sign * v[main];
        const float slope_b = v[second] / size, slope_c = v[third] / size;
        // The smaller the slopes, the more the length must change until other components round to different integers.
        const float steepest = std::max(std::fabs(slope_b), std::fabs(slope_c));
        const float stride =
            steepest * kMostStride > kMove ? std::floor(std::max(1.0F, kMove / steepest)) : kMostStride;
        const float first = std::min(nearest(size) - stride * (kLengths / 2), middle_ - stride * (kLengths - 1));
        // A vector that is short relative to a step has no meaningful perpendicular error.
        if (!(first > stride * kLengths)) return nearest(wanted);
        const float shorter = 1 / (1 + slope_b * slope_b + slope_c * slope_c);
        std::array<float, kLengths> b, c, off;
        for (std::size_t i = 0; i < off.size(); ++i) {
            const float length = first + stride * static_cast<float>(i), real_b = slope_b * length,
                        real_c = slope_c * length;
            b[i] = nearest(real_b);
            c[i] = nearest(real_c);
            const float db = b[i] - real_b, dc = c[i] - real_c, along = db * slope_b + dc * slope_c;
            off[i] = db * db + dc * dc - along * along * shorter;
        }
        const auto best = static_cast<std::size_t>(std::min_element(off.begin(), off.end()) - off.begin());
        v[main] = sign * (first + stride * static_cast<float>(best));
        v[second] = b[best];
        v[third] = c[best];
        return {v[0], v[1], v[2]};
    }

  private:
    /// kLengths: number of lengths that are tried. kMove: intended change of the larger of the two other components
    /// from one length to the next, in steps. kMostStride: maximum distance between two lengths, in steps.
    static constexpr int kLengths = 8;
    static constexpr float kMove = 0.4F, kMostStride = 40;

    [[nodiscard]] float nearest(float value) const {
        const float at = std::max(0.0F, std::min(value + middle_ + 0.5F, last_));
        return static_cast<float>(static_cast<int>(at)) - middle_;
    }

    float middle_, last_;
};

}  // namespace

void roundTexels(std::span<Vec3> texels, std::uint32_t width, const TexelRounding& rounding, Parallel& parallel,
                 const Allocator* allocator, const StepCallback& report_step) {
    const auto height = static_cast<std::uint32_t>(texels.size() / width);
    const StepRounding steps(rounding);
    // Rounding errors so far, in steps. Each texel is rounded while its neighbors are fixed. An error along the vector
    // does not change its direction, and is ignored.
    Buffer<Vec3> off(allocator, texels.size(), Vec3{});
    const auto roundRow = [&](std::uint32_t y) {
        const std::size_t here = std::size_t{y} * width, above = std::size_t{y > 0 ? y - 1 : height - 1} * width,
                          below = std::size_t{y + 1 < height ? y + 1 : 0} * width;
        for (std::uint32_t x = 0; x < width; ++x) {
            if (!rounding.keeps.empty() && rounding.keeps[here + x]) continue;
            const std::size_t left = x > 0 ? x - 1 : width - 1, right = x + 1 < width ? x + 1 : 0;
            const Vec3 sides = (off[here + left] + off[here + right]) + (off[above + x] + off[below + x]);
            const Vec3 corners = (off[above + left] + off[above + right]) + (off[below + left] + off[below + right]);
            // Integral of the product of two bilinear filters: 4/9 at the texel itself, 1/9 at its sides, 1/36 at its
            // corners.
            const Vec3 others = 0.25F * sides + 0.0625F * corners;
            // The rounding error of an earlier round is subtracted.
            const Vec3 wanted = steps.middle() * texels[here + x] - off[here + x];
            Vec3& error = off[here + x];
            Vec3 chosen;
            if (rounding.keeps_lengths) {
                chosen = steps.nearest(wanted - others);
                error = chosen - wanted;
            } else {
                chosen = steps.nearestAcross(wanted - others);
                error = chosen - wanted;
                const float squared = dot(wanted, wanted);
                if (squared > 0) error = error - (dot(error, wanted) / squared) * wanted;
            }
            texels[here + x] = (1 / steps.middle()) * chosen;
        }
    };
    // If lengths may change, a second round gains almost nothing.
    const std::uint64_t rounds = rounding.keeps_lengths ? 2 : 1;
    for (std::uint64_t round = 0; round < rounds; ++round) {
        const StepCallback report_row = [&](std::uint64_t done, std::uint64_t total) {
            report_step(round * total + done, rounds * total);
        };
        forNonAdjacentRows(parallel, height, roundRow, report_step ? report_row : StepCallback());
    }
}

}  // namespace tspace
