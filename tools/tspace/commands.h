// SPDX-License-Identifier: MIT
// The commands. Each works through its inputs, prints, and says how it went.
#pragma once

#include "arguments.h"

namespace tspace::tool {

ExitCode runGenerate(const GenerateArguments& arguments);
ExitCode runDiff(const DiffArguments& arguments);
ExitCode runIdentify(const IdentifyArguments& arguments);
ExitCode runInspect(const InspectArguments& arguments);
ExitCode runCheck(const CheckArguments& arguments);
ExitCode runBake(const BakeArguments& arguments);
ExitCode runMapError(const MapErrorArguments& arguments);
ExitCode runFlipGreen(const FlipGreenArguments& arguments);
ExitCode runRender(const RenderArguments& arguments);
ExitCode runConvertMap(const ConvertMapArguments& arguments);
ExitCode runHeightToNormal(const HeightToNormalArguments& arguments);
ExitCode runView(const ViewArguments& arguments);

}  // namespace tspace::tool
