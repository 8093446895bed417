#include "core/library/SoftboxRigs.h"

namespace patina::library {
namespace {

constexpr glm::vec3 kWhite{1.0f, 1.0f, 1.0f};
constexpr glm::vec3 kWarm{1.0f, 0.93f, 0.84f};
constexpr glm::vec3 kCool{0.86f, 0.93f, 1.0f};

Softbox box(const char* name, float azimuthDeg, float elevationDeg, float widthDeg, float heightDeg,
            float intensity, const glm::vec3& color = kWhite, float softness = 0.15f,
            float rollDeg = 0.0f) {
    Softbox softbox;
    softbox.name = name;
    softbox.azimuthDeg = azimuthDeg;
    softbox.elevationDeg = elevationDeg;
    softbox.widthDeg = widthDeg;
    softbox.heightDeg = heightDeg;
    softbox.intensity = intensity;
    softbox.color = color;
    softbox.softness = softness;
    softbox.rollDeg = rollDeg;
    return softbox;
}

} // namespace

const std::vector<SoftboxRig>& softboxRigs() {
    static const std::vector<SoftboxRig> rigs{
        {"Three-Point",
         "A key from the camera's left, a fill from its right and a rim light from behind.",
         {box("Key", -20, 38, 46, 46, 10, kWarm, 0.2f),
          box("Fill", 95, 12, 64, 56, 1.6f, kCool, 0.6f),
          box("Rim", -170, 34, 16, 64, 22, kWhite, 0.1f)}},
        {"Top Softbox",
         "One large box overhead and a reflector below, as for products on a table.",
         {box("Top", 30, 82, 86, 64, 8, kWhite, 0.25f),
          box("Reflector", 30, -48, 84, 44, 1.2f, kWarm, 0.6f)}},
        {"Rim Strips",
         "Two tall strips behind the model draw its outline, a weak top light fills the front.",
         {box("Left Strip", -92, 8, 12, 110, 16, kWhite, 0.2f),
          box("Right Strip", 152, 8, 12, 110, 16, kWhite, 0.2f),
          box("Top", 20, 76, 50, 34, 3, kCool, 0.4f)}},
        {"Window",
         "Four panes of daylight from the side and a warm lamp across the room.",
         {box("Upper Left Pane", -32, 46, 20, 24, 15, kCool, 0.02f),
          box("Upper Right Pane", -62, 46, 20, 24, 15, kCool, 0.02f),
          box("Lower Left Pane", -36, 17, 20, 24, 15, kCool, 0.02f),
          box("Lower Right Pane", -58, 17, 20, 24, 15, kCool, 0.02f),
          box("Lamp", 120, 20, 14, 14, 14, {1.0f, 0.72f, 0.42f}, 0.6f)}},
        {"Light Tent",
         "Soft light from everywhere with dark gaps between, which metal and glass need.",
         {box("Left", -60, 8, 78, 84, 1.2f, kWhite, 0.3f),
          box("Right", 120, 8, 78, 84, 1.2f, kWhite, 0.3f),
          box("Back", -150, 12, 70, 70, 0.8f, kWhite, 0.3f),
          box("Top", 30, 90, 84, 84, 1.6f, kWhite, 0.3f)}},
    };
    return rigs;
}

} // namespace patina::library
