#include "core/edit/Parameters.h"

#include "core/base/Check.h"
#include "core/document/Document.h"
#include "core/document/Lighting.h"
#include "core/document/ViewChoices.h"
#include "core/edit/Edit.h"
#include "core/edit/ParameterAccess.h"
#include "core/edit/ParameterChoices.h"
#include "core/edit/ParameterConditions.h"
#include "core/io/DisplayTransform.h"
#include "core/light/Blackbody.h"
#include "core/light/Light.h"
#include "core/light/Lights.h"
#include "core/material/MaterialInputs.h"

#include <algorithm>
#include <array>

namespace patina {
namespace {

// The environment's image is a map to the user, although it is stored without a map's adjustments.
ParameterValue getEnvironmentImage(const Document& document, Id id) {
    const Environment* environment = document.environment(id);
    CHECK(environment != nullptr);
    MapSlot slot;
    slot.source = environment->source;
    slot.image = environment->fileImage;
    slot.problem = environment->problem;
    return slot;
}

void setEnvironmentImage(Document& document, Id id, const ParameterValue& value) {
    CHECK(std::holds_alternative<MapSlot>(value));
    const MapSlot& slot = std::get<MapSlot>(value);
    Environment* environment = document.environment(id);
    CHECK(environment != nullptr);
    environment->source = slot.source;
    environment->fileImage = slot.image;
    if (environment->kind == EnvironmentKind::Image)
        environment->image = slot.image;
    environment->problem = slot.problem;
}

using PlacementGet = const glm::vec3& (Placement::*)() const;
using PlacementSet = void (Placement::*)(const glm::vec3&);

const Placement& placementOf(const Document& document, Id id) {
    const MeshInstance* mesh = document.mesh(id);
    CHECK(mesh != nullptr);
    return mesh->placement;
}

template <PlacementGet Get>
ParameterValue getPlaced(const Document& document, Id id) {
    return (placementOf(document, id).*Get)();
}

template <PlacementSet Set>
void setPlaced(Document& document, Id id, const ParameterValue& value) {
    MeshInstance* mesh = document.mesh(id);
    CHECK(mesh != nullptr && std::holds_alternative<glm::vec3>(value));
    (mesh->placement.*Set)(std::get<glm::vec3>(value));
}

template <PlacementGet Get>
ParameterValue placedByFile(const Document& document, Id id) {
    return (placementOf(document, id).back().*Get)();
}

std::string_view lightIntensityUnit(const Document& document, Id id) {
    return intensityUnit(document.light(id)->type);
}

// --- Rows ---

constexpr auto kPicture = Affects::Picture;
constexpr auto kGeometry = Affects::Geometry | Affects::Bakes;
constexpr auto kEnvironment = Affects::EnvironmentMap;
constexpr auto kSwitch = Affects::Picture | Affects::Structure; // lists show what is on

using Text = std::string_view;

template <std::size_t... N>
constexpr auto joined(const std::array<ParameterInfo, N>&... parts) {
    std::array<ParameterInfo, (N + ...)> all{};
    auto end = all.begin();
    ((end = std::copy(parts.begin(), parts.end(), end)), ...);
    return all;
}

struct Range {
    float min, max;
};
constexpr Range kUnit{0.0f, 1.0f};

template <class P>
constexpr ParameterInfo row(ParameterType type, Text id, Text label, Text group, Text help,
                            Affects affects) {
    ParameterInfo info;
    info.id = id;
    info.label = label;
    info.group = group;
    info.scope = ElementOf<typename P::Element>::kScope;
    info.type = type;
    info.help = help;
    info.affects = affects;
    info.get = &getMember<P>;
    info.set = &setMember<P>;
    return info;
}

template <auto... Members>
constexpr ParameterInfo number(Text id, Text label, Text group, Range soft, Range hard,
                               int decimals, Text unit, Text help,
                               Affects affects = Affects::Picture) {
    auto info = row<Path<Members...>>(ParameterType::Float, id, label, group, help, affects);
    info.softMin = soft.min, info.softMax = soft.max;
    info.hardMin = hard.min, info.hardMax = hard.max;
    info.decimals = decimals;
    info.unit = unit;
    return info;
}

// What stands for 0 where that is no number.
constexpr ParameterInfo zeroIs(Text name, ParameterInfo info) {
    info.zeroName = name;
    return info;
}

// A full turn, -180…180.
template <auto... Members>
constexpr ParameterInfo angle(Text id, Text label, Text group, Text help,
                              Affects affects = Affects::Picture) {
    constexpr Range kTurn{-180.0f, 180.0f};
    auto info = number<Members...>(id, label, group, kTurn, kTurn, 1, "°", help, affects);
    info.wraps = true;
    return info;
}

constexpr ParameterInfo wrapped(ParameterInfo info) {
    info.wraps = true;
    return info;
}

template <auto... Members>
constexpr ParameterInfo color(Text id, Text label, Text group, Text help,
                              Affects affects = Affects::Picture) {
    return row<Path<Members...>>(ParameterType::Color, id, label, group, help, affects);
}

template <auto... Members>
constexpr ParameterInfo vector(Text id, Text label, Text group, Range soft, Range hard, Text unit,
                               Text help, Affects affects = Affects::Picture) {
    auto info = number<Members...>(id, label, group, soft, hard, 3, unit, help, affects);
    info.type = ParameterType::Vector;
    return info;
}

// Of where a mesh stands.
template <PlacementGet Get, PlacementSet Set>
constexpr ParameterInfo placed(Text id, Text label, Range soft, Range hard, Text unit, Text help) {
    ParameterInfo info;
    info.id = id;
    info.label = label;
    info.group = "Place";
    info.scope = Scope::Mesh;
    info.type = ParameterType::Vector;
    info.softMin = soft.min, info.softMax = soft.max;
    info.hardMin = hard.min, info.hardMax = hard.max;
    info.unit = unit;
    info.help = help;
    info.affects = kGeometry;
    info.get = &getPlaced<Get>;
    info.set = &setPlaced<Set>;
    info.resetTo = &placedByFile<Get>;
    return info;
}

template <auto... Members>
constexpr ParameterInfo flag(Text id, Text label, Text group, Text help,
                             Affects affects = Affects::Picture) {
    return row<Path<Members...>>(ParameterType::Bool, id, label, group, help, affects);
}

template <auto... Members, class E, std::size_t N>
constexpr ParameterInfo choice(Text id, Text label, Text group, const Choices<E, N>& choices,
                               Text help, Affects affects = Affects::Picture) {
    auto info = row<Path<Members...>>(ParameterType::Choice, id, label, group, help, affects);
    info.choices = choices.names();
    info.choiceLabels = choices.labels();
    info.hardMax = info.softMax = static_cast<float>(N - 1);
    info.decimals = 0;
    return info;
}

template <auto... Members>
constexpr ParameterInfo text(Text id, Text label, Text group, Text help,
                             Affects affects = Affects::Structure) {
    return row<Path<Members...>>(ParameterType::Text, id, label, group, help, affects);
}

// The value of an input of the material and its map, as kMaterialInputs describes them.
template <std::size_t I>
constexpr std::array<ParameterInfo, 2> inputRows() {
    constexpr const MaterialInputInfo& kInput = kMaterialInputs[I];
    constexpr const InputParameters& kText = kInput.parameters;
    ParameterInfo value;
    if constexpr (kInput.role == InputRole::Color)
        value = color<kInput.color>(kText.value(), kText.label, kText.group, kText.help);
    else
        value = number<kInput.number>(kText.value(), kText.label, kText.group,
                                      {kText.softMin, kText.softMax},
                                      {kText.hardMin, kText.hardMax}, 3, "", kText.help);
    value.alias = kText.alias;
    auto map = row<Path<kInput.map>>(ParameterType::Map, kText.map, kText.mapLabel, kText.group,
                                     kText.mapHelp, Affects::Picture);
    map.alias = kText.mapAlias;
    map.mapEncoding = kInput.encoding;
    map.mapChannel = kInput.channel;
    return {value, map};
}

template <MaterialInput Input>
constexpr auto inputRows() {
    return inputRows<static_cast<std::size_t>(Input)>();
}

constexpr auto inGroup(Text group) {
    return [group](const MaterialInputInfo& info) { return info.parameters.group == group; };
}

template <std::size_t First, std::size_t... I>
constexpr auto inputRowsFrom(std::index_sequence<I...>) {
    return joined(inputRows<First + I>()...);
}

// The rows of all inputs of a group, which stand together in the table.
template <const Text& Group>
constexpr auto inputRowsOf() {
    constexpr auto kFirst =
        std::find_if(kMaterialInputs.begin(), kMaterialInputs.end(), inGroup(Group));
    constexpr auto kCount =
        std::count_if(kMaterialInputs.begin(), kMaterialInputs.end(), inGroup(Group));
    return inputRowsFrom<static_cast<std::size_t>(kFirst - kMaterialInputs.begin())>(
        std::make_index_sequence<static_cast<std::size_t>(kCount)>());
}

constexpr ParameterInfo environmentImage(Text id, Text label, Text group, Text help) {
    auto info = row<Path<&Environment::source>>(ParameterType::Map, id, label, group, help,
                                                Affects::Picture | Affects::EnvironmentMap);
    info.mapEncoding = ColorEncoding::Srgb;
    info.get = &getEnvironmentImage;
    info.set = &setEnvironmentImage;
    return info;
}

template <auto... Members>
constexpr ParameterInfo reference(Text id, Text label, Text group, Text help, Affects affects) {
    return row<Path<Members...>>(ParameterType::Reference, id, label, group, help, affects);
}

// How the scene uses its environments, whichever of them is edited.
constexpr ParameterInfo ofScene(ParameterInfo info) {
    info.scope = Scope::Environment;
    info.ofScene = true;
    return info;
}

constexpr ParameterInfo notNone(ParameterInfo info) {
    info.mayBeNone = false;
    return info;
}

// One of the environments.
template <auto... Members>
constexpr ParameterInfo environmentReference(Text id, Text label, Text group, Text help) {
    auto info = reference<Members...>(id, label, group, help, kSwitch | kEnvironment);
    info.refersTo = Scope::Environment;
    return ofScene(info);
}

constexpr ParameterInfo offered(std::string (*unavailable)(const Document&, int),
                                ParameterInfo info) {
    info.unavailable = unavailable;
    return info;
}

// OpenColorIO's displays are offered where there is a configuration to take them from.
std::string toneMapUnavailable(const Document& document, int choice) {
    if (static_cast<ToneMap>(choice) != ToneMap::OpenColorIo ||
        !openColorIoConfig(document.view.ocioConfig).empty())
        return {};
    return "OpenColorIO needs a configuration: choose one with view.ocioConfig, or set the "
           "environment variable OCIO to one";
}

// What a bake has to tell is offered where there is one.
std::string lightingUnavailable(const Document& document, int choice) {
    const auto mode = static_cast<LightingMode>(choice);
    if (mode == LightingMode::LightMap)
        return findBake(document, BakeKind::LightMap) != nullptr
                   ? std::string()
                   : "Light corrected by a light map needs a light map bake";
    if (mode == LightingMode::Radiosity)
        return document.triangleCount() > 0 ? std::string()
                                            : "Radiosity needs a visible mesh to light";
    if (!readsBake(mode) || hasTransfer(document))
        return {};
    return "Shadows and interreflection need a radiance transfer bake";
}

// A light that becomes another type keeps what it does to the scene.
std::vector<ParameterEdit> lightTypeEdits(const Document& document, Id id,
                                          const ParameterValue& type) {
    return editsTo(convertedLight(*document.light(id), static_cast<LightType>(std::get<int>(type)),
                                  document.bounds()));
}

// The environment that lights the scene and the second one change places where one takes the
// other's.
std::vector<ParameterEdit> firstEnvironmentEdits(const Document& document, Id,
                                                 const ParameterValue& first) {
    std::vector<ParameterEdit> edits{{findParameter("environment.first"), first}};
    if (document.mix.second != 0 && static_cast<int>(document.mix.second) == std::get<int>(first))
        edits.push_back(
            {findParameter("environment.second"), static_cast<int>(document.mix.first)});
    return edits;
}

// A second one is seen at once, and the first is not lost for it.
std::vector<ParameterEdit> secondEnvironmentEdits(const Document& document, Id,
                                                  const ParameterValue& second) {
    const int id = std::get<int>(second);
    const bool same = static_cast<Id>(id) == document.mix.first;
    std::vector<ParameterEdit> edits{{findParameter("environment.second"), same ? 0 : id}};
    if (id != 0 && !same && document.mix.second == 0 && document.mix.fade == 0.0f)
        edits.push_back({findParameter("environment.fade"), 0.5f});
    return edits;
}

constexpr ParameterInfo withEdits(std::vector<ParameterEdit> (*onSet)(const Document&, Id,
                                                                      const ParameterValue&),
                                  ParameterInfo info) {
    info.onSet = onSet;
    return info;
}

constexpr ParameterInfo unitOfElement(std::string_view (*unitOf)(const Document&, Id),
                                      ParameterInfo info) {
    info.unitOf = unitOf;
    return info;
}

// --- Where a parameter has a say ---

constexpr ParameterInfo only(const Condition& applies, ParameterInfo info) {
    info.applies = &applies;
    return info;
}

constexpr ParameterInfo whileHolds(const Condition& works, ParameterInfo info) {
    info.works = &works;
    return info;
}

// --- The table ---

constexpr Text kSoloHelp = "While any light or environment is solo, everything else is off, as on "
                           "a mixing desk.";

using M = Material;
using E = Environment;
using X = EnvironmentMix;
using V = View;
using S = ShadingModel;
using L = Light;
using B = Softbox;

// clang-format off
constexpr Text kSurface = "Surface";

constexpr auto kParameters = joined(
  std::array{
    text<&M::name>("material.name", "Name", "Material", "What the material is called in lists, exports and scripts."),
  },
  inputRowsOf<kSurface>(),
  std::array{
    only(kInRoughDiffuse, number<&M::diffuseRoughness>("material.diffuseRoughness", "Diffuse roughness", "Surface", kUnit, kUnit, 3, "", "How powdery the body is: 0 is smooth and 1 dust; used by the diffuse models Oren-Nayar and EON.")),
    number<&M::ior>("material.ior", "Refractive index", "Surface", {1.0f, 2.5f}, {1.0f, 3.0f}, 3, "", "How strongly a non-metal refracts and reflects: water 1.33, glass and plastic 1.5, diamond 2.42. At 1.5 the exact model uses the scene's index (model.ior)."),
  },
  inputRows<MaterialInput::Normal>(),
  std::array{
    choice<&M::normalConvention>("material.normalConvention", "Normal map format", "Normal & occlusion", kNormalConventions, "Which way the normal map's green channel points; choose the other one when bumps look like dents."),
  },
  inputRows<MaterialInput::Occlusion>(),
  inputRows<MaterialInput::Emissive>(),
  std::array{
    number<&M::emissiveStrength>("material.emissiveStrength", "Emission strength", "Emission", {0.0f, 20.0f}, {0.0f, 1e5f}, 2, "", "Multiplies the emission colour, for screens and lights brighter than white paper."),
    only(kWithAlpha, number<&M::opacity>("material.opacity", "Opacity", "Transparency", kUnit, kUnit, 3, "", "1 is solid and 0 invisible; used when the alpha mode is cut-out or blend.")),
    choice<&M::alphaMode>("material.alphaMode", "Alpha mode", "Transparency", kAlphaModes, "Whether opacity is ignored, cuts holes with a hard edge, or lets the background show through."),
    only(kInCutOut, number<&M::alphaCutoff>("material.alphaCutoff", "Alpha cutoff", "Transparency", kUnit, kUnit, 3, "", "In cut-out mode, points of lower opacity than this are left out.")),
    flag<&M::doubleSided>("material.doubleSided", "Double-sided", "Transparency", "Shows the back of thin surfaces such as leaves and cloth, with their normal turned to the viewer.", kPicture | Affects::Bakes),
  },
  inputRows<MaterialInput::Transmission>(),
  std::array{
    flag<&M::thinWalled>("material.thinWalled", "Thin-walled", "Transmission", "A sheet such as a window pane or a soap bubble, through which light goes straight; switched off, the surface bounds a solid body that refracts and absorbs: a closed mesh, or what is inside never ends."),
    whileHolds(kSolidGlass, color<&M::attenuationColor>("material.attenuationColor", "Attenuation colour", "Transmission", "Colour that white light has after the attenuation distance inside a solid body; path tracing shows it.")),
    whileHolds(kSolidGlass, number<&M::attenuationDistance>("material.attenuationDistance", "Attenuation distance", "Transmission", {0.0f, 1.0f}, {0.0f, 1e5f}, 4, "m", "How far light goes in a solid body until it has the attenuation colour; 0 lets it through without loss.")),

    text<&E::name>("environment.name", "Name", "Image", "What the environment is called in lists and scripts; without a name it is called by what it shows."),
    choice<&E::kind>("environment.kind", "Kind", "Image", kEnvironmentKinds, "What surrounds and lights the model: an image, a computed clear sky, or softboxes in a dark room.", kEnvironment),
    environmentImage("environment.image", "Image", "Image", "Image of the environment that lights the scene."),
    only(kInImageFile, choice<&E::layout>("environment.layout", "Layout", "Image", kEnvironmentLayouts, "How the file shows the environment; automatic guesses it from the file, choose another one when the guess is wrong.", Affects::Picture | Affects::EnvironmentMap)),
    only(kInImage, number<&E::removedSources>("environment.removedSources", "Removed sources", "Image", {0.0f, 4.0f}, {0.0f, 8.0f}, 0, "", "How many of the image's brightest sources (the sun, light fixtures) are removed from it because lights replace them; Extract Sun counts it up.", kEnvironment)),
    only(kInSky, angle<&E::sky, &Sky::sunAzimuthDeg>("environment.skySunAzimuthDeg", "Sun azimuth", "Sky", "The compass direction of the sun; 0 is the model's front, positive values turn towards +X.", kEnvironment)),
    only(kInSky, number<&E::sky, &Sky::sunElevationDeg>("environment.skySunElevationDeg", "Sun elevation", "Sky", {0.0f, 90.0f}, {0.0f, 90.0f}, 1, "°", "How high the sun stands: 0 is sunset, 90 is overhead.", kEnvironment)),
    only(kInSky, number<&E::sky, &Sky::turbidity>("environment.skyTurbidity", "Haze", "Sky", {2.0f, 10.0f}, {2.0f, 10.0f}, 2, "", "How much haze is in the air (turbidity): 2 is a clear mountain day, 10 a milky one with a weak sun.", kEnvironment)),
    only(kInSky, number<&E::sky, &Sky::sunScale>("environment.skySunScale", "Sun strength", "Sky", {0.0f, 2.0f}, {0.0f, 100.0f}, 2, "", "Multiplies the light of the sun's disc; 0 leaves only the sky.", kEnvironment)),
    only(kInSky, number<&E::sky, &Sky::sunDiameterDeg>("environment.skySunDiameterDeg", "Sun size", "Sky", {0.5f, 20.0f}, {0.1f, 90.0f}, 2, "°", "Diameter of the sun's disc, 0.53° in nature; a larger sun gives softer shadows and as much light.", kEnvironment)),
    only(kInSky, number<&E::sky, &Sky::groundAlbedo>("environment.skyGroundAlbedo", "Ground", "Sky", kUnit, kUnit, 2, "", "How much light the ground reflects: 0.1 is wet soil, 0.3 sand, 0.8 snow.", kEnvironment)),
    only(kInSoftboxes, color<&E::softboxAmbient>("environment.softboxAmbient", "Ambient", "Softboxes", "Light of the room between the softboxes.", kEnvironment)),
    angle<&E::rotationDeg>("environment.rotationDeg", "Rotation", "Adjustments", "Rotates the environment about the vertical axis, counter-clockwise seen from above."),
    angle<&E::tiltDeg>("environment.tiltDeg", "Tilt", "Adjustments", "Tilts the environment before it is rotated: positive values bring what is above towards the model's front."),
    angle<&E::rollDeg>("environment.rollDeg", "Roll", "Adjustments", "Rolls the environment before it is tilted, counter-clockwise seen from the model's front."),
    number<&E::exposureEv>("environment.exposureEv", "Brightness", "Adjustments", {-6.0f, 6.0f}, {-24.0f, 24.0f}, 2, "EV", "Brightens the environment; each step doubles its light."),
    flag<&E::enabled>("environment.enabled", "On", "Mix", "Switches the light of the environment, and its picture, on or off.", kSwitch),
    flag<&E::solo>("environment.solo", "Solo", "Mix", kSoloHelp, kSwitch),
    color<&E::tint>("environment.tint", "Tint", "Mix", "Colours the light of the environment like a filter in front of it."),
    notNone(withEdits(firstEnvironmentEdits, environmentReference<&X::first>("environment.first", "Environment", "Mix", "Which of the environments lights the scene."))),
    withEdits(secondEnvironmentEdits, environmentReference<&X::second>("environment.second", "Second environment", "Mix", "Another one of the environments, that the light can be faded to.")),
    ofScene(only(kWithSecond, number<&X::fade>("environment.fade", "Cross-fade", "Mix", kUnit, kUnit, 3, "", "Fades from the environment at 0 to the second one at 1, between them to a mix of the light of both; of no effect without a second one."))),
    ofScene(choice<&V::background>("environment.background", "Background", "Background", kBackgrounds, "What is seen behind the model; the light on it stays the same.")),
    ofScene(only(kBlurred, number<&V::backgroundBlur>("environment.backgroundBlur", "Background blur", "Background", kUnit, kUnit, 2, "", "How far out of focus the environment behind the model is."))),
    ofScene(only(kColored, color<&V::backgroundColor>("environment.backgroundColor", "Background colour", "Background", "Colour behind the model when the background is a colour."))),

    text<&B::name>("softbox.name", "Name", "Softbox", "What the softbox is called in lists and scripts."),
    flag<&B::enabled>("softbox.enabled", "On", "Softbox", "Switches the softbox on or off.", kEnvironment),
    number<&B::intensity>("softbox.intensity", "Intensity", "Softbox", {0.0f, 50.0f}, {0.0f, 1e6f}, 2, "nit", "Radiance of the softbox: how bright it looks in a mirror.", kEnvironment),
    color<&B::color>("softbox.color", "Colour", "Softbox", "Colour of the softbox; its brightness is set by the intensity.", kEnvironment),
    angle<&B::azimuthDeg>("softbox.azimuthDeg", "Azimuth", "Softbox", "The compass direction of its centre; 0 is the model's front, positive values turn towards +X.", kEnvironment),
    number<&B::elevationDeg>("softbox.elevationDeg", "Elevation", "Softbox", {-90.0f, 90.0f}, {-90.0f, 90.0f}, 1, "°", "How high its centre stands above the horizon.", kEnvironment),
    number<&B::widthDeg>("softbox.widthDeg", "Width", "Softbox", {1.0f, 120.0f}, {0.5f, 170.0f}, 1, "°", "The angle that its width is seen under: larger is softer light.", kEnvironment),
    number<&B::heightDeg>("softbox.heightDeg", "Height", "Softbox", {1.0f, 120.0f}, {0.5f, 170.0f}, 1, "°", "The angle that its height is seen under.", kEnvironment),
    angle<&B::rollDeg>("softbox.rollDeg", "Roll", "Softbox", "Turns it about its centre, counter-clockwise seen from the model.", kEnvironment),
    number<&B::softness>("softbox.softness", "Edge softness", "Softbox", kUnit, kUnit, 2, "", "How much of it fades out towards its edges: 0 is a sharp rectangle.", kEnvironment),

    choice<&S::distribution>("model.distribution", "Distribution", "Highlight", kDistributions, "How the tiny facets of a rough surface are tilted: GGX has the long tails that real materials show."),
    choice<&S::visibility>("model.visibility", "Visibility", "Highlight", kVisibilities, "How facets hide each other: Smith's models are derived (correlated: with their heights), Schlick's fits are those of the Unreal Engine 4 for lights, k = (r + 1)² / 8, and for image-based light, k = α / 2; the last two are shortcuts of old."),
    flag<&S::multiScatter>("model.multiScatter", "Energy compensation", "Highlight", "Gives back the light that bounces more than once between facets; without it rough metals are too dark."),
    choice<&S::fresnel>("model.fresnel", "Fresnel", "Fresnel", kFresnels, "How reflection grows towards grazing angles: by Schlick's approximation, or by Fresnel's exact equations for non-metals or for metals."),
    only(kInSchlickF90, number<&S::f90>("model.f90", "Grazing reflectance", "Fresnel", kUnit, kUnit, 3, "", "Reflectance at grazing angles for Schlick with f90; real surfaces reach 1.")),
    only(kInDielectric, number<&S::ior>("model.ior", "Refractive index", "Fresnel", {1.0f, 2.5f}, {1.0f, 10.0f}, 3, "", "Refractive index, for the exact dielectric, of all non-metals whose own is left at 1.5 (material.ior): water 1.33, glass and plastic 1.5, diamond 2.42.")),
    only(kInConductor, vector<&S::conductorN>("model.conductorN", "Index n", "Fresnel", {0.05f, 5.0f}, {0.01f, 50.0f}, "", "Real part of the metals' refractive index at red, green and blue for the exact conductor; it replaces their base colour.")),
    only(kInConductor, vector<&S::conductorK>("model.conductorK", "Extinction k", "Fresnel", {0.0f, 10.0f}, {0.0f, 50.0f}, "", "Imaginary part of the metals' refractive index at red, green and blue for the exact conductor.")),
    choice<&S::diffuse>("model.diffuse", "Diffuse", "Diffuse", kDiffuses, "How light that enters the body leaves it: evenly (Lambert), or flatter and brighter at the edges as from powder, cloth and clay."),
    choice<&S::lobeDirection>("model.lobeDirection", "Reflections from", "Image-based light", kLobeDirections, "Where rough reflections of the environment are looked up: around the lobe's mean direction, or around the mirror direction as is usual but off by several degrees."),

    choice<&View::exposureMode>("view.exposureMode", "Exposure mode", "Exposure", kExposureModes, "Fixed, or automatic like an eye that gets used to how bright the picture is."),
    whileHolds(kMetered, choice<&View::exposureMeter>("view.exposureMeter", "Metered", "Exposure", kExposureMeters, "What automatic exposure and the photographic key measure: the surfaces alone, so that neither a dark room nor a bright sky around them decides, or the whole frame with its background, as a camera does.")),
    number<&View::exposureEv>("view.exposureEv", "Exposure", "Exposure", {-6.0f, 6.0f}, {-24.0f, 24.0f}, 2, "EV", "Brightens the whole picture like a camera's exposure, each step doubles it; it corrects automatic exposure."),
    offered(toneMapUnavailable, choice<&View::toneMap>("view.toneMap", "Tone mapping", "Tone curve", kToneMaps, "How light that is brighter than the screen is brought into its range; PBR Neutral keeps base colours as they are.")),
    only(kInReinhard, flag<&View::reinhardPerChannel>("view.reinhardPerChannel", "Per channel", "Tone curve", "Applies Reinhard's curve to red, green and blue each: bright colours fade to white and shift in hue; otherwise to luminance, which keeps hue and saturation until a channel is cut.")),
    only(kInPhotographic, flag<&View::reinhardAutoKey>("view.reinhardAutoKey", "Automatic key", "Tone curve", "Lets the photographic operator find its key from the darkest, average and brightest light of the picture.")),
    whileHolds(kKeyByHand, only(kInPhotographic, number<&View::reinhardKey>("view.reinhardKey", "Key", "Tone curve", {0.045f, 0.72f}, {0.045f, 0.72f}, 3, "", "Brightness that the picture's average gets: 0.045 for a night, 0.18 for an ordinary scene, 0.72 for snow."))),
    only(kInPhotographic, number<&View::reinhardWhite>("view.reinhardWhite", "White point", "Tone curve", {0.0f, 16.0f}, {0.0f, 10000.0f}, 2, "", "Smallest scaled luminance that becomes white; 0 is none, and nothing is ever quite white.")),
    only(kInExponential, number<&View::exponentialK>("view.exponentialK", "Rate k", "Tone curve", {0.1f, 8.0f}, {0.01f, 100.0f}, 2, "", "The k of 1 - exp(-k L): how quickly light comes near white.")),
    only(kNotInOpenColorIo, choice<&View::displayTransfer>("view.displayTransfer", "Transfer curve", "Display", kDisplayTransfers, "What the display expects: the sRGB curve, or a pure power; OpenColorIO brings its own.")),
    only(kInGamma, number<&View::displayGamma>("view.displayGamma", "Display gamma", "Display", {1.0f, 3.0f}, {1.0f, 4.0f}, 2, "", "Exponent of a display that is a pure power.")),
    text<&View::ocioConfig>("view.ocioConfig", "OpenColorIO configuration", "Display", "File with OpenColorIO's displays and views; empty means the one that the environment variable OCIO names.", kPicture),
    text<&View::ocioDisplay>("view.ocioDisplay", "OpenColorIO display", "Display", "Display of the OpenColorIO configuration; empty means its default.", kPicture),
    text<&View::ocioView>("view.ocioView", "OpenColorIO view", "Display", "View of the OpenColorIO display; empty means the display's default.", kPicture),
    number<&View::camera, &Camera::fovDeg>("view.fovDeg", "Field of view", "Camera and lighting", {10.0f, 90.0f}, {1.0f, 170.0f}, 1, "°", "Vertical angle that the camera sees: small like a telephoto lens, large like a wide-angle lens."),
    flag<&View::camera, &Camera::lens, &Lens::depthOfField>("view.depthOfField", "Depth of field", "Camera and lighting", "Looks through a lens in place of a pinhole: what is nearer or farther than the focus distance is blurred."),
    whileHolds(kWithLens, number<&View::camera, &Camera::lens, &Lens::fStop>("view.fStop", "F-stop", "Camera and lighting", {0.1f, 22.0f}, {0.01f, 1000.0f}, 2, "", "Focal length of a 24 mm high sensor's lens over the diameter of its aperture: a smaller number blurs more. No real lens is below 0.7; metres away from large things it takes such to see any blur.")),
    whileHolds(kWithLens, number<&View::camera, &Camera::lens, &Lens::focusDistance>("view.focusDistance", "Focus distance", "Camera and lighting", {0.1f, 20.0f}, {1e-4f, 1e6f}, 3, "m", "How far in front of the camera, along its axis, things are sharp; Focus Here in the menu View takes it from a click.")),
    offered(lightingUnavailable, choice<&View::lighting>("view.lighting", "Lighting", "Camera and lighting", kLightings, "How the environment lights the scene: image-based light; one dominant light (N·L); SH irradiance; transfer of an open sky; baked transfer with its soft shadows; and with interreflection; image-based light corrected by a baked light map; radiosity, which solves all light of diffuse surfaces.")),
    only(kWithBounces, number<&View::bounces>("view.bounces", "Bounces", "Camera and lighting", {0.0f, 8.0f}, {-1.0f, 64.0f}, 0, "", "How often light may bounce between surfaces under interreflected transfer; -1 is never, 0 as often as the bake was made for.")),
    only(kInRadiosity, zeroIs("auto", number<&View::radiosityArea>("view.radiosityArea", "Element area", "Camera and lighting", {0.0f, 0.1f}, {0.0f, 1e6f}, 4, "m²", "Largest area of the elements that radiosity divides surfaces into; 0 divides the scene into about 4,000."))),
    only(kInRadiosity, number<&View::radiosityAdaptive>("view.radiosityAdaptive", "Adaptive", "Camera and lighting", kUnit, {0.0f, 10.0f}, 2, "", "Divides elements further where the light on one differs by more than this share of it; 0 divides evenly.")),
    only(kInRadiosity, whileHolds(kDivided, choice<&View::radiosityDivideBy>("view.radiosityDivideBy", "Divide by", "Camera and lighting", kRadiosityDivisions, "What tells where elements are too coarse: how light differs from corner to corner; light that is hidden in part, as in penumbras; or by how much a quadratic interpolation differs from the linear one that is shown, as the mean (L1), the root mean square (L2) or the largest difference (L∞) over an element."))),
    only(kWithShots, whileHolds(kDivided, flag<&View::radiosityDynamic>("view.radiosityDynamic", "Divide while shooting", "Camera and lighting", "Elements are divided while light is shot, whenever half of what was unshot has been, instead of after whole solutions."))),
    only(kWithShots, zeroIs("none", number<&View::radiosityPatches>("view.radiosityPatches", "Patch area", "Camera and lighting", {0.0f, 1.0f}, {0.0f, 1e6f}, 4, "m²", "Largest area of the patches that shoot in place of elements, which only receive: fewer form factors for as fine a light. Larger than the elements; 0 lets each element shoot."))),
    only(kInRadiosity, choice<&View::radiositySolver>("view.radiositySolver", "Solver", "Camera and lighting", kRadiositySolvers, "How the light of all elements is solved: gathered sweep by sweep, from the newest values or the last sweep's; shot, the most power first (progressive), the most per area first (Southwell), or ahead of what will arrive; exactly, up to 2,048 elements; or over links between clusters.")),
    only(kInRadiosity, whileHolds(kWithFactors, choice<&View::radiosityMethod>("view.radiosityMethod", "Form factors", "Camera and lighting", kRadiosityMethods, "What finds which share of an element's light arrives where: rays; a hemicube; polygons in closed form, times their visibility; or what is drawn on a paraboloid map."))),
    only(kByRays, whileHolds(kWithFactors, number<&View::radiosityRays>("view.radiosityRays", "Rays", "Camera and lighting", {16.0f, 1024.0f}, {1.0f, 65536.0f}, 0, "", "Rays per element that find which share of its light arrives where: four times as many halve the noise."))),
    only(kByHemicube, whileHolds(kWithFactors, number<&View::radiosityCells>("view.radiosityCells", "Cells", "Camera and lighting", {16.0f, 256.0f}, {2.0f, 1024.0f}, 0, "", "Cells along an edge of each hemicube; an odd number counts as one more. Twice as many take four times as long."))),
    only(kByPolygons, whileHolds(kWithFactors, number<&View::radiosityPairs>("view.radiosityPairs", "Pairs of points", "Camera and lighting", {1.0f, 64.0f}, {1.0f, 65536.0f}, 0, "", "Pairs of points that decide how much of one element another one sees, where they are not clear of all others."))),
    only(kByParaboloid, whileHolds(kWithFactors, number<&View::radiosityTexels>("view.radiosityTexels", "Texels", "Camera and lighting", {16.0f, 512.0f}, {2.0f, 4096.0f}, 0, "", "Texels along the diameter of each paraboloid map. Twice as many take four times as long."))),
    only(kByLinks, number<&View::radiosityLinkError>("view.radiosityLinkError", "Link error", "Camera and lighting", {0.01f, 10.0f}, {1e-6f, 1e6f}, 3, "ppm", "Millionths of the emitted light that a link between clusters may be wrong by: smaller values divide links further, and take longer.")),
    only(kInRadiosity, flag<&View::radiosityClassic>("view.radiosityClassic", "Glow is shot", "Camera and lighting", "Glowing surfaces send their light as all elements do, as in the textbooks; else it counts as direct light, which is exact but for its shadows.")),
    number<&View::reflectionMix>("view.reflectionMix", "Diffuse / reflection", "Camera and lighting", kUnit, kUnit, 2, "", "Fades between diffuse light alone (0) and reflections alone (1); in the middle both show in full. Reflections that are left out take nothing from the diffuse light."),

    text<&L::name>("light.name", "Name", "Light", "What the light is called in lists, exports and scripts."),
    withEdits(lightTypeEdits, choice<&L::type>("light.type", "Type", "Light", kLightTypes, "A point emits from one position in all directions, a directional light from far away like the sun, a spot in a cone; spheres and rectangles emit from an area and make soft highlights.", kPicture | Affects::Structure)),
    flag<&L::enabled>("light.enabled", "On", "Light", "Switches the light on or off.", kPicture | Affects::Structure),
    flag<&L::solo>("light.solo", "Solo", "Light", kSoloHelp, kPicture | Affects::Structure),
    whileHolds(kColoredByHand, color<&L::color>("light.color", "Colour", "Light", "Colour of the light; its brightness is set by the intensity.")),
    flag<&L::usesTemperature>("light.usesTemperature", "Use temperature", "Light", "Takes the colour of a glowing body of the temperature below instead of the colour above."),
    whileHolds(kColoredByTemperature, number<&L::temperatureK>("light.temperatureK", "Temperature", "Light", {1000.0f, 12000.0f}, {kMinTemperatureK, kMaxTemperatureK}, 0, "K", "Colour temperature: a candle has 1900 K, a light bulb 2700 K, the midday sun 5500 K, a clear sky 10000 K and more.")),
    unitOfElement(lightIntensityUnit, number<&L::intensity>("light.intensity", "Intensity", "Light", {0.0f, 20.0f}, {0.0f, 1e6f}, 3, "cd, lx or nit", "Brightness: in lux at a surface that faces a directional light, in candela for points and spots, in nit (candela per m²) for spheres and rectangles.")),
    number<&L::gainEv>("light.gainEv", "Gain", "Light", {-6.0f, 6.0f}, {-24.0f, 24.0f}, 2, "EV", "Brightens the light in the mix, its intensity staying as it is; each step doubles it."),
    color<&L::tint>("light.tint", "Tint", "Light", "Colours the light in the mix like a filter in front of it; white leaves it as it is."),
    only(kOfPlaced, vector<&L::position>("light.position", "Position", "Place", {-10.0f, 10.0f}, {-1e6f, 1e6f}, "m", "Where the light stands: right, up and towards the viewer; not of a directional light.")),
    only(kOfDirected, angle<&L::azimuthDeg>("light.azimuthDeg", "Azimuth", "Place", "The compass direction that light of a directional light, spot or rectangle comes from; 0 is the model's front, positive values turn towards +X.")),
    only(kOfDirected, number<&L::elevationDeg>("light.elevationDeg", "Elevation", "Place", {-90.0f, 90.0f}, {-90.0f, 90.0f}, 1, "°", "How far from above the light of a directional light, spot or rectangle comes: 90 is straight down, 0 level.")),
    only(kOfRectangles, angle<&L::rollDeg>("light.rollDeg", "Roll", "Place", "Turns a rectangle about the direction it emits in.")),
    only(kOfRanged, number<&L::range>("light.range", "Range", "Shape", {0.0f, 50.0f}, {0.0f, 1e6f}, 2, "m", "Where light of a point or spot ends, fading smoothly; 0 lets it go on for ever, as real light does.")),
    only(kOfSpots, number<&L::innerConeDeg>("light.innerConeDeg", "Inner cone", "Shape", {0.0f, 90.0f}, {0.0f, 90.0f}, 1, "°", "Half angle of the cone within which a spot has its full intensity.")),
    only(kOfSpots, number<&L::outerConeDeg>("light.outerConeDeg", "Outer cone", "Shape", {0.1f, 90.0f}, {0.1f, 90.0f}, 1, "°", "Half angle of the cone outside of which a spot is dark.")),
    only(kOfSpheres, number<&L::radius>("light.radius", "Radius", "Shape", {0.0f, 2.0f}, {0.0f, 1e5f}, 3, "m", "Radius of a sphere light.")),
    only(kOfRectangles, number<&L::width>("light.width", "Width", "Shape", {0.0f, 5.0f}, {0.0f, 1e5f}, 3, "m", "Width of a rectangle light.")),
    only(kOfRectangles, number<&L::height>("light.height", "Height", "Shape", {0.0f, 5.0f}, {0.0f, 1e5f}, 3, "m", "Height of a rectangle light.")),
    only(kOfCasters, flag<&L::castsShadow>("light.castsShadow", "Shadow", "Shadow", "Lets the meshes cast shadows in the light of a spot or a directional light.")),
    whileHolds(kCasting, only(kOfCasters, number<&L::shadowSoftness>("light.shadowSoftness", "Softness", "Shadow", {0.0f, 10.0f}, {0.0f, 45.0f}, 2, "°", "How large the source appears from the scene, which makes shadows soft: the sun has 0.53°; 0 gives hard edges."))),

    text<&MeshInstance::name>("mesh.name", "Name", "Mesh", "What the mesh is called in lists, exports and scripts."),
    flag<&MeshInstance::visible>("mesh.visible", "Visible", "Mesh", "Shows the mesh, and lets it take part in bakes.", kGeometry),
    reference<&MeshInstance::material>("mesh.material", "Material", "Mesh", "The material that covers the mesh.", kGeometry),
    placed<&Placement::position, &Placement::setPosition>("mesh.position", "Position", {-10.0f, 10.0f}, {-kMaxPosition, kMaxPosition}, "m", "Where the origin of the mesh stands: right, up and towards the viewer; a reset puts it back where its file has it."),
    wrapped(placed<&Placement::rotationDeg, &Placement::setRotationDeg>("mesh.rotationDeg", "Rotation", {-180.0f, 180.0f}, {-180.0f, 180.0f}, "°", "Rotates the mesh about its origin: about X, then Y, then Z of the world.")),
    placed<&Placement::scale, &Placement::setScale>("mesh.scale", "Scale", {0.1f, 10.0f}, {kMinScale, kMaxScale}, "", "Scales the mesh along its own axes; 1 is the size that its file says, unless the file scales it."),
  });
// clang-format on

constexpr bool hasRow(const MaterialInputInfo& input) {
    return std::any_of(kParameters.begin(), kParameters.end(),
                       [&](const ParameterInfo& info) { return info.id == input.parameters.map; });
}
static_assert(std::all_of(kMaterialInputs.begin(), kMaterialInputs.end(), hasRow),
              "the rows of every input of the material");

} // namespace

std::string_view whyIdle(const ParameterInfo& info, const Document& document, Id element) {
    for (const Condition* condition : {info.applies, info.works})
        if (condition != nullptr && !condition->holds(document, element))
            return condition->otherwise;
    return {};
}

std::span<const ParameterInfo> parameters() {
    return kParameters;
}

ParameterValue ParameterInfo::defaultValue() const {
    Document document;
    const Id only = document.takeId();
    switch (scope) {
    case Scope::Material:
        document.materials.emplace_back().id = only;
        break;
    case Scope::Light:
        document.lights.emplace_back().id = only;
        break;
    case Scope::Mesh:
        document.meshes.emplace_back().id = only;
        break;
    case Scope::Softbox:
        document.environment().softboxes.emplace_back().id = only;
        break;
    case Scope::Environment:
    case Scope::Model:
    case Scope::View:
        return get(document, 0);
    }
    return get(document, only);
}

std::string whyUnavailable(const ParameterInfo& info, const Document& document, int choice) {
    return info.unavailable == nullptr ? std::string() : info.unavailable(document, choice);
}

const ParameterInfo* findParameter(std::string_view idOrAlias) {
    const auto found =
        std::find_if(kParameters.begin(), kParameters.end(), [&](const ParameterInfo& info) {
            return info.id == idOrAlias || (!info.alias.empty() && info.alias == idOrAlias);
        });
    return found == kParameters.end() ? nullptr : &*found;
}

const ParameterInfo* mapOf(const ParameterInfo& parameter) {
    return findParameter(std::string(parameter.id) + ".map");
}

std::string_view scopeName(Scope scope) {
    switch (scope) {
    case Scope::Material:
        return "material";
    case Scope::Light:
        return "light";
    case Scope::Environment:
        return "environment";
    case Scope::View:
        return "view";
    case Scope::Mesh:
        return "mesh";
    case Scope::Softbox:
        return "softbox";
    case Scope::Model:
        return "model";
    }
    CHECK(false);
    return {};
}

} // namespace patina
