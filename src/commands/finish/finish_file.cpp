// SPDX-License-Identifier: MIT
// finishFile: fixes winding and normals, runs check, repairs the remaining findings, bakes, and checks the result; its
// report as JSON.
#include "tspace/bake_file.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "commands/bake/bake_outputs.h"
#include "commands/bake/bake_report.h"
#include "commands/bake/bake_step.h"
#include "commands/check/check_report.h"
#include "commands/check/scene_checks.h"
#include "commands/finish/finish_report.h"
#include "commands/generate/generate_model.h"
#include "commands/generate/generate_report.h"
#include "commands/generate/generate_steps.h"
#include "core/base/numbers.h"
#include "model/gltf/container.h"
#include "model/gltf/primitive_reader.h"
#include "model/io/atomic_output.h"
#include "model/io/file_error.h"
#include "model/io/file_io.h"
#include "model/io/named_files.h"
#include "model/io/output_name.h"
#include "model/read/read_scene.h"

namespace tspace {
namespace {

/// Tools that create UVs, which tspace does not.
constexpr const char* kUvMakers = "unwrapping tools can create UVs (Blender's Smart UV Project, xatlas, RizomUV)";

/// Returns whether recomputed normals fix the finding. `was_turned`: triangles of the primitive were flipped after
/// normals had been computed for the old winding.
bool asksForNormals(const Finding& finding, bool was_turned) {
    switch (finding.code) {
        case FindingCode::normalsMissing: return true;
        case FindingCode::normalsAgainstWinding:
            return finding.severity == Severity::error || (finding.severity == Severity::warning && was_turned);
        case FindingCode::normalsNotFinite:
        case FindingCode::normalsNotUnit: return finding.severity == Severity::error;
        default: return false;
    }
}

bool asksForMorphNormals(const Finding& finding) {
    return finding.code == FindingCode::morphNormalsWrong && finding.severity == Severity::error;
}

CheckedModel runCheck(ModelFile& model, const FinishOptions& options) {
    CheckOptions check;
    check.images = options.images;
    check.weld_distance = options.weld_distance;
    check.execution = options.execution;
    check.progress = options.progress;
    return checkScene(model.scene(options.images), check);
}

/// A model during processing, and its report.
class ModelInWork {
  public:
    /// `output`: path of the result, which determines relative paths of referenced files.
    ModelInWork(const std::string& path, const std::string& output, bool is_low, const FinishOptions& options,
                FinishedModel& report)
        : path_(path), output_(output), is_low_(is_low), options_(options), report_(report) {
        report_.path = path;
    }

    void finish() {
        ModelFile file = read();
        before_ = runCheck(file, options_);
        report_.before = before_.report;
        if (!options_.page.empty()) views_ = viewsHtml(file, "before");
        GenerateOptions generate = generateOptions();
        runFirst(std::move(file), generate, {});
        if (std::vector<std::uint32_t> right = rightMeshes(); !right.empty()) {
            // The faces of an OBJ file form one surface, whose winding is fixed or kept as a whole.
            generate.mend_winding = !isObj();
            runFirst(read(), generate, {.wound_meshes = std::move(right)});
        }
        const gltf::RecomputedNormals wishes = wishesOf();
        if (!wishes.base.empty()) {
            GenerateOptions again = generate;
            again.mend_winding = false;
            take(run(*std::move(model_), again, {.normals = wishes}), wishes);
            check_ = runCheck(*model_, options_);
        }
        generate.mend_winding = true;  // keeps warnOfWinding from suggesting --fix-winding, which finish does not have
        warnOfWinding(generate, report_.made);
        writeGlb();
        report_.without_uvs_count = check_.without_uvs_count;
    }

    /// Returns the model after all changes; bytes() contains the same model as a GLB.
    [[nodiscard]] ModelFile& model() { return *model_; }
    /// Returns pictures of the model before the changes; empty unless a page is written.
    [[nodiscard]] const std::string& views() const { return views_; }
    [[nodiscard]] const Bytes& bytes() const { return bytes_; }
    [[nodiscard]] const CheckReport& checked() const { return check_.report; }

  private:
    [[nodiscard]] bool isObj() const { return lowerExtension(path_) == ".obj"; }

    [[nodiscard]] ModelFile read() const {
        const auto tell = [&](std::uint64_t done) {
            if (options_.progress) options_.progress("reading", done, 1);
        };
        tell(0);
        ModelFile file(path_, options_.file, options_.execution, options_.progress);
        tell(1);
        return file;
    }

    [[nodiscard]] GenerateOptions generateOptions() const {
        GenerateOptions generate;
        generate.selection.existing = ExistingTangents::repair;
        generate.tangents.faces = Faces::automatic;
        generate.mend_winding = options_.mend_winding;
        generate.maps.read = options_.images;
        generate.normals.compute.weld_distance = options_.weld_distance;
        if (options_.normals != FinishNormals::none) {
            generate.normals.compute.weighting = NormalWeighting::best;
            generate.normals.compute.crease_angle_deg = is_low_ ? 180 : options_.crease_angle_deg;
            generate.normals.compute.denoise = options_.denoise;
        }
        generate.execution = options_.execution;
        generate.progress = options_.progress;
        return generate;
    }

    void runFirst(ModelFile&& file, const GenerateOptions& generate, const GenerateStep& step) {
        report_.made = run(std::move(file), generate, step);
        check_ = report_.made.changed ? runCheck(*model_, options_) : before_;
    }

    /// Returns meshes whose normals fit their triangles less well after flipping. Recomputed normals fit in either
    /// case.
    [[nodiscard]] std::vector<std::uint32_t> rightMeshes() {
        if (options_.normals == FinishNormals::all) return {};
        const auto wasMade = [&](const Finding& finding) {
            const PrimitiveReport* const primitive = primitiveOf(finding);
            return primitive != nullptr && primitive->normals_generated;
        };
        const auto sharesOf = [&](const CheckReport& report) {
            std::map<std::uint32_t, double> shares;  // share of the surface, by mesh
            for (const Finding& finding : report.findings) {
                if (finding.code == FindingCode::normalsAgainstWinding && !wasMade(finding))
                    shares[finding.mesh] += finding.surface_share;
            }
            return shares;
        };
        const std::map<std::uint32_t, double> before = sharesOf(report_.before);
        std::vector<std::uint32_t> right;
        for (const auto& [mesh, share] : sharesOf(check_.report)) {
            const auto known = before.find(mesh);
            const auto turned = turnedIn(mesh);
            if (turned == 0 || share <= (known == before.end() ? 0 : known->second)) continue;
            right.push_back(mesh);
            report_.left_winding_count += turned;
            if (isObj()) break;
        }
        return right;
    }

    /// Returns null if the finding refers to the whole file.
    [[nodiscard]] const PrimitiveReport* primitiveOf(const Finding& finding) const {
        if (finding.place.empty()) return nullptr;
        for (const PrimitiveReport& primitive : report_.made.primitives) {
            if (primitive.mesh == finding.mesh && primitive.primitive == finding.primitive) return &primitive;
        }
        return nullptr;
    }

    [[nodiscard]] std::uint64_t turnedIn(std::uint32_t mesh) const {
        std::uint64_t count = 0;
        for (const MendedWindingReport& mended : report_.made.windings) {
            if (mended.mesh == mesh || isObj()) count += mended.winding.turned_count;
        }
        return count;
    }

    /// Processes a model, and stores the result in `model_`.
    GenerateReport run(ModelFile&& model, GenerateOptions generate, GenerateStep step) {
        generate.file = options_.file;
        step.output = output_;
        gltf::GeneratedModel made = generateModel(std::move(model), path_, generate, true, step);
        tspace::addWarnings(generate, {}, true, made.report);
        report_.normals_scaled_count += made.normals_scaled_count;
        report_.attributes_repaired = report_.attributes_repaired || made.attributes_repaired;
        gltf::Document& document = made.model.document();
        made.report.input_files = {path_};
        made.report.input_files.insert(made.report.input_files.end(), document.input_files.begin(),
                                       document.input_files.end());
        document.files = NamedFiles::none();
        model_.emplace(std::move(made.model));
        return std::move(made.report);
    }

    /// Writes the model to `bytes_`.
    void writeGlb() {
        gltf::Document& document = model_->gltf().document();
        gltf::OutputTarget target = gltf::outputTarget(document, output_, true);
        target.same_folder = isObj();  // its images are embedded, or in the folder of the output
        AtomicOutput files({.sink = [this](ByteSpan bytes) {
            bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
            return true;
        }});
        std::vector<std::string> warnings;
        if (report_.made.changed) {
            gltf::writeDocument(document, target, files, warnings, options_.execution);
        } else {
            gltf::writeUnchanged(document, target, files, warnings);
        }
        files.commit();
        addWarnings(std::move(warnings));
        report_.made.output_bytes = bytes_.size();
    }

    /// Adds those of the warnings that are not yet in the report.
    void addWarnings(std::vector<std::string>&& more) {
        std::vector<std::string>& warnings = report_.made.warnings;
        for (std::string& warning : more) {
            if (std::find(warnings.begin(), warnings.end(), warning) == warnings.end())
                warnings.push_back(std::move(warning));
        }
    }

    /// Returns the normals to recompute after fixing the winding.
    [[nodiscard]] gltf::RecomputedNormals wishesOf() const {
        if (options_.normals == FinishNormals::none) return {};
        const std::vector<PrimitiveReport>& primitives = report_.made.primitives;
        // Normals of STL files only indicate the orientation of triangles, not their shading.
        const bool all = options_.normals == FinishNormals::all || lowerExtension(path_) == ".stl";
        gltf::RecomputedNormals wishes{.base = std::vector<bool>(primitives.size(), all),
                                       .morphs = std::vector<bool>(primitives.size(), false)};
        for (const Finding& finding : check_.report.findings) {
            const PrimitiveReport* const found = primitiveOf(finding);
            if (found == nullptr) continue;
            const auto i = static_cast<std::size_t>(found - primitives.data());
            if (asksForMorphNormals(finding)) wishes.morphs[i] = true;
            if (asksForNormals(finding, found->winding_mended_count != 0)) wishes.base[i] = true;
        }
        const auto any = [](const std::vector<bool>& list) {
            return std::find(list.begin(), list.end(), true) != list.end();
        };
        return any(wishes.base) || any(wishes.morphs) ? wishes : gltf::RecomputedNormals{};
    }

    /// Merges the report of a second run.
    void take(GenerateReport&& second, const gltf::RecomputedNormals& wishes) {
        GenerateReport& made = report_.made;
        made.changed = made.changed || second.changed;
        // The second run has replaced normals that the first one warned about.
        std::erase_if(made.warnings,
                      [](const std::string& warning) { return warning.starts_with(gltf::kInvalidNormals); });
        addWarnings(std::move(second.warnings));
        for (std::size_t i = 0; i < made.primitives.size() && i < second.primitives.size(); ++i) {
            if (!wishes.base[i] && !wishes.morphs[i]) continue;
            PrimitiveReport& now = second.primitives[i];
            PrimitiveReport& first = made.primitives[i];
            now.winding_mended_count = first.winding_mended_count;
            now.winding_mended = std::move(first.winding_mended);
            now.vertices_before = first.vertices_before;
            now.source_list = first.source_list;
            first = std::move(now);
        }
    }

    const std::string &path_, &output_;
    bool is_low_;
    const FinishOptions& options_;
    FinishedModel& report_;
    std::string views_ = {};
    std::optional<ModelFile> model_ = {};  ///< after the last run of generate
    Bytes bytes_ = {};
    CheckedModel before_ = {};  ///< result of check on the file
    CheckedModel check_ = {};   ///< result of check on `model_`, or on the file if generate changed nothing
};

BakeNames namesOf(const std::string& output) {
    const std::string stem = output.substr(0, output.find_last_of('.'));
    return {.output = stem + "_normal.png", .layers_output = stem + ".png"};
}

class Finishing {
  public:
    explicit Finishing(const FinishOptions& options) : options_(options) { inputs_.watch(options_.file); }

    FinishReport run(const std::string& input, const std::string& output) {
        requireEnding(output, {".glb", ".vrm"});
        // The low poly is processed first: it is small, and its faults are found early.
        ModelInWork model(input, output, false, options_, report_.model);
        if (options_.low.empty()) {
            tagInput(BakeInput::high, [&] { return model.finish(), true; });
            views_.model = model.views();
            addRemarks(report_.model);
            report_.check = model.checked();
            write(output, model.bytes(), model.model());
            return std::move(report_);
        }
        ModelInWork low(options_.low, output, true, options_, report_.low.emplace());
        tagInput(BakeInput::low, [&] { return low.finish(), true; });
        checkLow();
        tagInput(BakeInput::high, [&] { return model.finish(), true; });
        views_.model = model.views();
        noteNoise();
        views_.low = low.views();
        const Bytes baked = bake(input, output, low.model(), model.model());
        if (report_.bake->output_files.empty()) return std::move(report_);
        FileOptions content = options_.file;
        content.content = baked;
        ModelFile result(output, content);
        report_.check = runCheck(result, options_).report;
        addRemarks(*report_.low);
        write(output, baked, result);
        return std::move(report_);
    }

  private:
    /// Throws if no primitive of the low poly has UVs, because then nothing can be baked.
    void checkLow() const {
        if (report_.low->without_uvs_count < report_.low->made.primitives.size()) return;
        throw FileError{{.code = ErrorCode::missingAttribute,
                         .message = std::string("the low poly has no UVs, so no maps were baked; ") + kUvMakers,
                         .element = static_cast<std::uint64_t>(BakeInput::low)}};
    }

    void addRemarks(const FinishedModel& model) {
        if (model.left_winding_count != 0)
            report_.remarks.push_back(
                report::counted(model.left_winding_count, "triangle") +
                (model.left_winding_count == 1 ? " was" : " were") +
                " not flipped, because the existing normals fit the current winding; use --normals all to flip them");
        if (model.without_uvs_count == 0) return;
        const std::string which = model.without_uvs_count == 1
                                      ? "1 primitive has"
                                      : std::to_string(model.without_uvs_count) + " primitives have";
        report_.remarks.push_back(which + " no UVs, so no tangents and no maps were created; " + kUvMakers);
    }

    /// Adds a remark on noise that suggests an option of finish; the warning of the bake would suggest an option of
    /// bake.
    void noteNoise() {
        const auto& findings = report_.model.before.findings;
        const bool is_noisy = std::any_of(findings.begin(), findings.end(), [](const Finding& finding) {
            return finding.code == FindingCode::positionsNoisy;
        });
        const bool any_made = std::any_of(report_.model.made.primitives.begin(), report_.model.made.primitives.end(),
                                          [](const PrimitiveReport& primitive) { return primitive.normals.noise > 0; });
        if (is_noisy && !any_made)
            report_.remarks.emplace_back(
                "the positions of the high poly are noisy, but its normals were kept; if they show the noise, use "
                "--normals all");
    }

    /// Returns the model with its maps; the map files are added to the outputs.
    Bytes bake(const std::string& input, const std::string& output, ModelFile& low, ModelFile& high) {
        BakeFileOptions bake = options_.bake;
        bake.map.rays.weld_distance = options_.weld_distance;
        bake.out_mesh = output;
        bake.file = options_.file;
        bake.execution = options_.execution;
        bake.progress = options_.progress;
        Bytes bytes;
        AtomicOutput model({.sink = [&](ByteSpan more) {
            bytes.insert(bytes.end(), more.begin(), more.end());
            return true;
        }});
        const BakeNames names = namesOf(output);
        const BakeStep step{.sources = {.low = &low, .high = &high},
                            .layers_output = names.layers_output,
                            .notes_noise = false,
                            .inputs = inputs_,
                            .map_files = files_,
                            .model_files = model};
        report_.bake = bakeAsStep(options_.low, input, names.output, bake, step);
        return bytes;
    }

    /// Writes the output, and the page if requested. `bytes`: the output; `model`: the model that it contains.
    void write(const std::string& output, ByteSpan bytes, ModelFile& model) {
        report_.output_bytes = bytes.size();
        files_.add(output, bytes);
        if (!options_.page.empty()) {
            views_.now = viewsHtml(model, "finished");
            const std::string html =
                finishPage(report_, views_, output, bytes, options_.file, {options_.page_date, options_.page_command});
            files_.add(options_.page, std::span(reinterpret_cast<const std::uint8_t*>(html.data()), html.size()));
        }
        report_.output_files = files_.files();
        const auto own = std::find(report_.output_files.begin(), report_.output_files.end(), output);
        if (own != report_.output_files.end()) std::rotate(report_.output_files.begin(), own, own + 1);
        files_.commit();
    }

    FinishOptions options_;
    InputFiles inputs_ = {};
    AtomicOutput files_{{.sync = options_.file.sync, .inputs = &inputs_}};
    FinishReport report_ = {};
    FinishViews views_ = {};
};

}  // namespace

BakeFileOptions allMaps() {
    BakeFileOptions bake;
    for (std::uint32_t i = 0; i < kMapLayerCount; ++i) bake.layers.layers.push_back(static_cast<MapLayer>(i));
    return bake;
}

std::vector<std::string> finishOutputs(const std::vector<std::string>& others, const std::string& output,
                                       const FinishOptions& options) {
    if (options.low.empty()) return {output};
    BakeFileOptions bake = options.bake;
    bake.out_mesh = output;
    bake.file = options.file;
    return outputsToCompare(others, options.low, namesOf(output), bake);
}

Result<FinishReport> finishFile(const std::string& input, const std::string& output, const FinishOptions& options) {
    return atFileBorder([&]() -> Result<FinishReport> { return Finishing(options).run(input, output); });
}

}  // namespace tspace

namespace tspace::report {

// Report of finish as JSON and as sentences.

std::string findingCounts(const CheckReport& report) {
    return counted(report.error_count, "error") + ", " + counted(report.warning_count, "warning") + ", " +
           counted(report.note_count, "note");
}

std::vector<std::string> doneTo(const FinishedModel& model) {
    std::uint64_t faces = 0, turned = 0, hard_count = 0;
    for (const MendedWindingReport& mended : model.made.windings) {
        faces += mended.winding.face_count;
        turned += mended.winding.turned_count;
    }
    const Totals totals = totalsOf(model.made);
    double noise = 0, least = 180, most = 0;
    for (const PrimitiveReport& primitive : model.made.primitives) {
        if (!primitive.normals_generated) continue;
        noise = std::max(noise, double{primitive.normals.noise});
        const double angle = primitive.normals.crease_angle_deg;
        if (angle >= 180 || primitive.normals.face_count == 0) continue;
        ++hard_count;
        least = std::min(least, angle);
        most = std::max(most, angle);
    }
    std::vector<std::string> done;
    if (turned != 0) done.push_back(std::to_string(turned) + " of " + counted(faces, "triangle") + " flipped");
    if (totals.normals_generated != 0) {
        std::string text = "normals computed for " + std::to_string(totals.normals_generated) + " of " +
                           counted(totals.primitive_count, "primitive");
        if (totals.normals_replaced != 0)
            text += ", replacing existing ones for " + std::to_string(totals.normals_replaced);
        if (hard_count != 0)
            text += (most > least ? ", with crease angles from " + shortNumber(least) + " to "
                                  : std::string(", with a crease angle of ")) +
                    shortNumber(most) + " degrees";
        if (noise > 0) text += ", without the position noise (" + shortNumber(noise) + " of an edge length)";
        done.push_back(text);
    }
    if (totals.morph_normals_computed != 0)
        done.push_back("normals of " + counted(totals.morph_normals_computed, "morph target") + " recomputed");
    const std::uint64_t made = totals.actions[static_cast<std::size_t>(PrimitiveAction::generated)],
                        anew = totals.actions[static_cast<std::size_t>(PrimitiveAction::replaced)];
    if (made != 0) done.push_back("tangents computed for " + counted(made, "primitive"));
    if (anew != 0) done.push_back("tangents repaired or recomputed for " + counted(anew, "primitive"));
    if (model.normals_scaled_count != 0)
        done.push_back("normals of " + counted(model.normals_scaled_count, "primitive") + " scaled to unit length");
    if (model.attributes_repaired) done.emplace_back("unreadable attributes repaired or removed");
    if (totals.morph_deltas_computed != 0 && made + anew == 0)
        done.push_back("tangent deltas computed for " + counted(totals.morph_deltas_computed, "morph target"));
    if (done.empty()) done.emplace_back(model.made.changed ? "only the format was changed" : "no changes were needed");
    return done;
}

namespace {

Json finishedModelJson(const FinishedModel& model) {
    GenerateOutcome made{.input = model.path};
    made.result = model.made;
    CheckOutcome before{.input = model.path};
    before.result = model.before;
    return {{"made", generatedFileJson(made)},
            {"before", checkedFileJson(before)},
            {"done", doneTo(model)},
            {"withoutUvs", model.without_uvs_count},
            {"leftWinding", model.left_winding_count}};
}

}  // namespace

std::string finishJson(const Outcome<FinishReport>& outcome, const std::string& low, ExitCode exit_code) {
    const Result<FinishReport>& result = outcome.result;
    Json json = documentJson("tspace.finish/1", result.ok(), exit_code);
    json["input"] = outcome.input;
    json["low"] = low;
    json["output"] = outcome.output;
    json["seconds"] = outcome.seconds;
    json["error"] = errorJson(result ? nullptr : &result.error());
    if (!result) return jsonText(json);
    json["models"] = Json::array();
    json["models"].push_back(finishedModelJson(result->model));
    if (result->low) json["models"].push_back(finishedModelJson(*result->low));
    CheckOutcome check{.input = outcome.output};
    check.result = result->check;
    json["check"] = result->output_files.empty() ? Json() : checkedFileJson(check);
    json["bake"] = Json();
    if (result->bake) {
        Outcome<BakeFileReport> bake{.input = low, .output = outcome.output};
        bake.result = *result->bake;
        bake.seconds = outcome.seconds;
        json["bake"] = bakeDocument(bake, outcome.input, exit_code);
    }
    json["outputFiles"] = result->output_files;
    json["outputBytes"] = result->output_bytes;
    json["remarks"] = result->remarks;
    return jsonText(json);
}

}  // namespace tspace::report
