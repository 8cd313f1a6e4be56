// SPDX-License-Identifier: MIT
// Rows of the table: targets and measurements.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mesh.h"
#include "tspace/execution.h"

namespace tspace::bench {

/// One measured number of a row.
struct Cell {
    std::optional<double> value = {};
    double low = 0, high = 0;     ///< quartiles over rounds, for ratios of times; otherwise 0
    std::optional<double> asked;  ///< maximum target
    double ns = 0;                ///< nanoseconds per triangle, for times; otherwise 0
    bool busy = false;            ///< other work used the second core, so two threads could not be measured

    [[nodiscard]] bool pass() const { return !value || !asked || *value <= *asked; }
};

struct RowResult {
    std::string title = {};
    std::string unit = "x";
    Cell one_thread = {}, two_threads = {};
    std::string note = {};
    bool wrong = false;  ///< a result was wrong; `note` states why
};

/// Data shared by all rows: meshes by name, each created once, and results of checks, each performed once.
class Lab {
  public:
    /// rounds: 0 means the default number
    Lab(bool quick, int rounds, std::string shared_folder, std::string tool)
        : quick_(quick), rounds_(rounds > 0 ? rounds
                                 : quick    ? 5
                                            : 11),
          shared_(std::move(shared_folder)), tool_(std::move(tool)) {}

    [[nodiscard]] bool quick() const { return quick_; }
    [[nodiscard]] int rounds() const { return rounds_; }
    /// Returns the size of meshes in this run: "1M", or "100k" in a quick run.
    [[nodiscard]] std::string size() const { return quick_ ? "100k" : "1M"; }
    [[nodiscard]] const std::string& tool() const { return tool_; }
    /// Returns the path of a file of the shared test data.
    [[nodiscard]] std::string shared(const std::string& path) const { return shared_ + "/" + path; }

    /// Returns a mesh by name, which is SHAPE_SIZE, SHAPE_SIZE_ORDER or the path of a model. SHAPE: torus, sphere,
    /// grid, quads, soup (the torus with unindexed corners) or folds (a torus mirrored every tenth column). SIZE: 10k,
    /// 8M etc. ORDER: one of triangleOrders().
    const Mesh& mesh(const std::string& name);
    /// Returns the indexed triangles of the mesh with this name, as used by the plain loop.
    const Mesh& plainMesh(const std::string& name);
    /// Returns the result of findError, which is computed once for each job and mesh.
    const std::string& error(const std::string& job, const std::string& mesh);
    /// Returns all primitives of the shared models that have normals and UVs, unmodified.
    const std::vector<Mesh>& primitives();
    /// Releases the memory of all meshes.
    void forgetMeshes();

  private:
    bool quick_;
    int rounds_;
    std::string shared_, tool_;
    std::map<std::string, std::unique_ptr<Mesh>> meshes_, plain_meshes_;
    std::vector<Mesh> primitives_;
    std::map<std::string, std::string> errors_;
};

struct Row {
    std::string title;
    std::function<RowResult(Lab&)> measure;
};

std::vector<Row> speedRows();
std::vector<Row> manyMeshRows();
std::vector<Row> fileRows();
std::vector<Row> packRows();
std::vector<Row> memoryRows();
std::vector<Row> worstCaseRows();

}  // namespace tspace::bench
