// SPDX-License-Identifier: MIT
// A mesh of a generator or a scanner made ready for use: winding, normals, tangents, and with a low poly all maps baked onto it.
// CMake target tspace::asset. What generateFile, bakeFile and checkFile do, in one call: nothing is done that is right already.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tspace/asset.h"
#include "tspace/bake_file.h"
#include "tspace/check.h"

namespace tspace {

/// Which normals are made.
enum class FinishNormals : std::uint32_t {
    missing = 0,  ///< where there are none, and where checkFile calls those that are there an error
    all = 1,      ///< everywhere
    none = 2,     ///< none, but those that tangents need
};

/// BakeFileOptions with all maps.
BakeFileOptions allMaps();

struct FinishOptions {
    FinishNormals normals = FinishNormals::missing;
    /// Of normals that are made, by `best`: as NormalOptions has them. Those of the low poly have no hard edges, which would need
    /// seams of UVs.
    float crease_angle_deg = NormalOptions::crease_auto;
    float denoise = NormalOptions::denoise_auto;
    /// Which positions are one where normals are made and triangles turned: as NormalOptions has it.
    float weld_distance = NormalOptions::weld_auto;
    /// As GenerateOptions. A mesh stays as it is wound where check then finds more normals against their triangles than before:
    /// its normals fit its triangles as they are, and it renders right.
    bool mend_winding = true;
    bool images = true;  ///< as CheckOptions and GenerateOptions; maps are baked in any case
    /// A model with UVs in the place of the input, of which it is the high poly: the output is this one, with all maps. Empty:
    /// the output is the input.
    std::string low = {};
    /// How maps are baked. Its models, `out_mesh`, file, execution and progress are set by the call.
    BakeFileOptions bake = allMaps();
    std::string page = {};  ///< where to write a page for people, with pictures before and after; empty: nowhere
    std::string page_date = {},
                page_command = {};  ///< of the run, as the page says them: any text; empty: only the version
    FileOptions file = {};          ///< without `content`
    Execution execution = {};
    Progress progress = {};
};

/// What was done to a model.
struct FinishedModel {
    std::string path = {};
    GenerateReport made = {};  ///< winding, normals and tangents; names no output
    CheckReport before = {};
    std::uint64_t without_uvs_count = 0;  ///< primitives with triangles and without UVs
    /// Triangles that would have been turned in meshes that stay as they are wound.
    std::uint64_t left_winding_count = 0;
};

struct FinishReport {
    FinishedModel model = {};
    std::optional<FinishedModel> low = {};
    std::optional<BakeFileReport> bake = {};
    CheckReport check = {};                      ///< of the output
    std::vector<std::string> remarks = {};       ///< what could not be done, and what does it: one sentence each
    std::vector<std::string> output_files = {};  ///< the model first. Empty where no ray of an image met anything
    std::uint64_t output_bytes = 0;              ///< of the model
};

/// Reads `input` (any format), and writes `output`, a GLB. Right normals and tangents stay; where nothing is wrong a GLB is
/// copied byte for byte. Maps stand beside the output, OUT_normal.png, OUT_ao.png and so on, and those that glTF has a place for
/// in it too. All files appear at once or not at all. Errors: those of generateFile and bakeFile; Error::element is a BakeInput:
/// `high` for the input and `low` for the low poly.
Result<FinishReport> finishFile(const std::string& input, const std::string& output, const FinishOptions& options = {});

}  // namespace tspace
