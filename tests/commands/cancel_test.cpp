// SPDX-License-Identifier: MIT
// Progress callbacks are frequent enough for a call to end within a second after it is canceled, and a canceled call
// writes nothing.
#include <gtest/gtest.h>
#include <time.h>

#include <algorithm>
#include <functional>

#include "support/grid_obj.h"
#include "support/temp_folder.h"
#include "tspace/bake_file.h"
#include "tspace/callbacks.h"
#include "tspace/generate.h"
#include "tspace/normals.h"
#include "tspace/result.h"

namespace tspace::test {
namespace {

/// Returns the processor time of this thread, which does not depend on the load of the machine.
double seconds() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Runs call(progress) to its end, and then again several times, each time canceled at another callback.
void expectStops(const std::string& name, const TempFolder& folder,
                 const std::function<ErrorCode(const Progress&)>& call) {
    const std::set<std::string> inputs = folder.files();
    int count = 0;
    double last = seconds(), longest = 0;
    const auto measure = [&] {
        const double now = seconds();
        longest = std::max(longest, now - last);
        last = now;
    };
    const ErrorCode code = call([&](const char*, std::uint64_t, std::uint64_t) {
        measure();
        ++count;
    });
    measure();
    if (code == ErrorCode::unsupportedFile) GTEST_SKIP() << "this build bakes no maps";
    ASSERT_EQ(code, ErrorCode::ok) << name;
#ifdef NDEBUG  // builds with sanitizers are not optimized, and take up to 20 times as long
    EXPECT_LT(longest, 0.6) << name;
#endif
    for (const std::string& file : folder.files()) {
        if (!inputs.contains(file)) std::filesystem::remove(folder.path(file));
    }
    for (const int stop : {0, 1, count / 3, 2 * count / 3, count - 2}) {
        int left = stop;
        EXPECT_EQ(call([&](const char*, std::uint64_t, std::uint64_t) {
                      if (left-- == 0) throw Cancelled{};
                  }),
                  ErrorCode::cancelled)
            << name << ", callback " << stop << " of " << count;
        EXPECT_EQ(folder.files(), inputs) << name;
    }
}

template <class Report>
ErrorCode codeOf(const Result<Report>& result) {
    return result ? ErrorCode::ok : result.error().code;
}

TEST(Cancel, EndsFileCallsWithinASecond) {
    const TempFolder folder;
    const std::string high = folder.write("high.obj", gridObj(400, 0.01)), low = folder.write("low.obj", gridObj(8, 0));
    expectStops("generate OBJ", folder, [&](const Progress& progress) {
        GenerateOptions options;
        options.selection.all = options.mend_winding = true;
        options.normals.compute.weighting = NormalWeighting::best;
        options.normals.compute.crease_angle_deg = NormalOptions::crease_auto;
        options.progress = progress;
        return codeOf(generateFile(high, folder.path("a.glb").string(), options));
    });
    const std::string model = folder.path("model.glb").string();
    ASSERT_EQ(codeOf(generateFile(high, model)), ErrorCode::ok);
    expectStops("generate glTF", folder, [&](const Progress& progress) {
        GenerateOptions options;
        options.selection.all = options.normals.overwrite = options.mend_winding = true;
        options.selection.existing = ExistingTangents::replace;
        options.progress = progress;
        return codeOf(generateFile(model, folder.path("a.glb").string(), options));
    });
    expectStops("bake", folder, [&](const Progress& progress) {
        BakeFileOptions options;
        options.map.width = options.map.height = 512;
        options.progress = progress;
        return codeOf(bakeFile(low, model, folder.path("a.png").string(), options));
    });
    expectStops("finish", folder, [&](const Progress& progress) {
        FinishOptions options;
        options.progress = progress;
        return codeOf(finishFile(model, folder.path("a.glb").string(), options));
    });
}

}  // namespace
}  // namespace tspace::test
