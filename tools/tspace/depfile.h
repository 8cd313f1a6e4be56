// SPDX-License-Identifier: MIT
// --depfile: the outputs and inputs of a run, as a rule that make and ninja include.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "command_table.h"
#include "model/io/atomic_output.h"
#include "model/io/recorded_files.h"

namespace tspace::tool {

/// The dependency file of this run. It is put in place together with the last outputs, so that an error leaves neither.
/// Must exist before the run opens files; at most one may exist.
class Depfile {
  public:
    explicit Depfile(const std::string& path);
    ~Depfile();
    Depfile(const Depfile&) = delete;
    Depfile& operator=(const Depfile&) = delete;

    /// Returns the dependency file of this run; null: none was requested, or it is complete.
    static Depfile* ofRun();
    [[nodiscard]] const std::string& path() const { return path_; }

    /// Writes the rule for all outputs of the run, of which `held` will be put in place by this thread's HeldOutputs.
    /// Does nothing if there is no output. Fails with invalidOption if the file is one of the inputs. Throws
    /// std::bad_alloc.
    Result<Done> write(const std::vector<std::string>& held);

  private:
    std::string path_;
    RecordedFiles recorded_ = {};
    std::optional<ProtectedFiles> kept_;
};

/// Returns the rule "OUTPUTS: INPUTS", and an empty rule per input, so that make continues after an input has been
/// removed. Names are escaped for make and ninja; a name with a control character cannot be escaped: fails with
/// invalidOption.
Result<std::string> depfileText(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs);

/// Adds the option --depfile to a command that writes files.
void addDepfile(Command& command);

}  // namespace tspace::tool
