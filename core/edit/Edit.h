// Edits of a document as plain functions: what the editor's commands and the command line's --set
// are made of. Each keeps the document's promises: ids are unique, references lead somewhere,
// numbers are in range.
#pragma once

#include "core/base/Result.h"
#include "core/document/Document.h"
#include "core/edit/Change.h"

#include <string>
#include <vector>

namespace patina {

[[nodiscard]] bool targetExists(const Document& document, const Target& target);
// The name of a mesh, material, light or softbox, the title of an environment; empty where it has
// none.
[[nodiscard]] std::string nameOf(const Document& document, const Target& target);

// Whether a value of a Reference leads somewhere, or may lead nowhere; true of all other values.
[[nodiscard]] bool leadsSomewhere(const Document& document, const ParameterInfo& info,
                                  const ParameterValue& value);

// What setting the parameter means for views of the document.
[[nodiscard]] Change changeFor(const ParameterInfo& info, const Target& target);

// Sets the parameter to the value clamped to its range. Usage error when the element or a
// referenced material does not exist; the document is then untouched.
Result<Change> applyParameter(Document& document, const ParameterInfo& info, const Target& target,
                              const ParameterValue& value);

// What a user's edit of a parameter sets, itself included, in order and for one undo step: what the
// panels do and --set does. A light that becomes another type is converted, a first map sets its
// number (editsForMap()). The element must exist. What is read from files (a layout, an image) is
// up to the caller.
[[nodiscard]] std::vector<ParameterEdit> editsFor(const Document& document,
                                                  const ParameterInfo& info, const Target& target,
                                                  const ParameterValue& value);

// Everything of a light but its name, as edits of the light with its id.
[[nodiscard]] std::vector<ParameterEdit> editsTo(const Light& light);

// Putting a map on a material: a map multiplies its parameter's number, so where there was none
// before, the number first goes to 1 (white) and the map is seen as it was painted. Without this a
// metallic map on a non-metal would change nothing. The edits are for one undo step, in order.
[[nodiscard]] std::vector<ParameterEdit> editsForMap(const Document& document,
                                                     const ParameterInfo& map, const Target& target,
                                                     const MapSlot& slot);

// "Sun" becomes "Sun 2" when there is a light of that name; the same for the other lists.
[[nodiscard]] std::string uniqueMaterialName(const Document& document, const std::string& name);
[[nodiscard]] std::string uniqueLightName(const Document& document, const std::string& name);
[[nodiscard]] std::string uniqueMeshName(const Document& document, const std::string& name);
[[nodiscard]] std::string uniqueSoftboxName(const Document& document, const std::string& name);

// Adding gives the element a new id and a unique name, and returns the id.
Id addMaterial(Document& document, Material material);
Id addLight(Document& document, Light light);
// Directly below the original, with a name that says so. The original must exist.
Id duplicateMaterial(Document& document, Id material);
Id duplicateLight(Document& document, Id light);
// In the same place, behind all others, so that models stay together (core/document/SceneModels.h).
// The original must exist.
Id duplicateMesh(Document& document, Id mesh);

// More are neither made nor read.
inline constexpr std::size_t kMaxEnvironments = 64;
// Below the others, with ids of its own (its softboxes too); it may have no name. 0 when there are
// kMaxEnvironments. The mix stays as it is.
Id addEnvironment(Document& document, Environment environment);
// Directly below the original, which must exist.
Id duplicateEnvironment(Document& document, Id environment);
// Makes it the second of the mix, with what follows as when a user chooses it; 0: there is none.
void fadeTo(Document& document, Id environment);
// False when it does not exist or is the only one. Where it was the first of the mix its second
// one, or a neighbour, becomes it.
bool removeEnvironment(Document& document, Id environment);

inline constexpr std::size_t kMaxSoftboxes = 256;
// Added to the environment that lights the scene. Like lights; 0 when it has kMaxSoftboxes. The
// environment's image follows with resolveEnvironment(), as after each edit of what it is generated
// from.
Id addSoftbox(Document& document, Softbox softbox);
Id duplicateSoftbox(Document& document, Id softbox);
bool removeSoftbox(Document& document, Id softbox);

// False when there is no such element. Meshes of a removed material take the first one that is
// left; when none is left, a default one is made for them. Bakes stay attached (they show as
// stale).
bool removeMaterial(Document& document, Id material);
bool removeLight(Document& document, Id light);
bool removeMesh(Document& document, Id mesh);

// Gives a material the look of another, which keeps neither its id nor its name. The material must
// exist.
void replaceLook(Document& document, Id material, const Material& look);

// Attaches a bake in the place of one of the same kind.
void attachBake(Document& document, BakeArtifactPtr bake);
bool removeBake(Document& document, BakeKind kind);
[[nodiscard]] BakeArtifactPtr findBake(const Document& document, BakeKind kind); // or null
[[nodiscard]] bool hasTransfer(const Document& document); // a bake of radiance transfer
// How often light may bounce in what the transfer bakes hold; 0: none holds bounces.
[[nodiscard]] int bakedBounces(const Document& document);

} // namespace patina
