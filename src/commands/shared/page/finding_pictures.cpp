// SPDX-License-Identifier: MIT
#include "commands/shared/page/finding_pictures.h"

#include <algorithm>
#include <map>

#include "commands/shared/page/place_pictures.h"
#include "commands/shared/page/remedy.h"
#include "model/io/file_error.h"

namespace tspace {

struct FindingPictures::Model {
    /// The model after a command.
    struct MendedModel {
        MendedModel(const std::string& input, const FileOptions& options, const Scene& before,
                    const GenerateOptions& command)
            : model(mendedScene(input, options, command)), pairs(pairPrimitives(before, model.scene())) {}

        PicturedModel model;
        std::vector<PrimitivePair> pairs;
    };

    /// A command that was run: a model, or why there is none.
    struct Mending {
        std::unique_ptr<MendedModel> model = {};
        std::string why_not = {};
    };

    Model(std::string path, const FileOptions& options) : input(std::move(path)), file(options), before(input, file) {}

    Mending& mendedBy(const RemedyCommand& command) {
        const auto [mending, is_new] = mended.try_emplace(command.text);
        if (is_new) run(*command.options, mending->second);
        return mending->second;
    }

    void run(const GenerateOptions& command, Mending& mending) {
        try {
            mending.model = std::make_unique<MendedModel>(input, file, before.scene(), command);
        } catch (const FileError& failure) {
            mending.why_not = "It cannot be run here: " + failure.error.message + ".";
        }
    }

    std::string input;
    FileOptions file;
    PicturedModel before;
    std::map<std::string, Mending> mended = {};
};

FindingPictures::FindingPictures(const std::string& input, const FileOptions& options)
    : model_(std::make_unique<Model>(input, options)) {}

FindingPictures::~FindingPictures() = default;

FindingPicture FindingPictures::draw(const Finding& finding) {
    FindingPicture result;
    const std::size_t primitive = findPrimitive(model_->before.scene(), finding.mesh, finding.primitive);
    if (finding.place.empty() || primitive == kNoPrimitive) return result;
    // A picture with computed tangents would hide that the file has none.
    const bool lacks = finding.code == FindingCode::tangentsMissing || finding.code == FindingCode::tangentsIgnored;
    const RenderFrames frames = lacks ? RenderFrames::stored : RenderFrames::automatic;
    const std::vector<std::size_t> triangles =
        trianglesAt(model_->before.scene().primitives[primitive], finding.vertices);
    result.before = drawPlace(model_->before.lit(frames), RenderShow::lit, primitive, triangles);
    const std::optional<RemedyCommand> command = commandIn(finding.remedy);
    if (result.before.empty() || !command) return result;
    result.command = command->text;
    if (!command->options) {
        result.why_no_after = "It leaves a choice open.";
        return result;
    }
    const Model::Mending& mending = model_->mendedBy(*command);
    if (!mending.model) {
        result.why_no_after = mending.why_not;
        return result;
    }
    const auto pair = std::find_if(mending.model->pairs.begin(), mending.model->pairs.end(),
                                   [&](const PrimitivePair& candidate) { return candidate.a == primitive; });
    if (pair != mending.model->pairs.end() && pair->b != kNoPrimitive) {
        const std::vector<std::size_t> partners = partnersOf(*pair, triangles);
        if (partners.size() == triangles.size())
            result.after = drawPlace(mending.model->model.lit(frames), RenderShow::lit, pair->b, partners);
    }
    if (result.after.empty()) result.why_no_after = "It cuts this place into other triangles.";
    if (result.after == result.before) {
        result.after.clear();
        result.why_no_after = "It changes nothing that this picture shows.";
    }
    return result;
}

}  // namespace tspace
