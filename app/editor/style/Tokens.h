// The editor's colours and distances, in one table. The palette, the style sheet (as @name) and
// the widgets that paint themselves take them from here.
#pragma once

#include <QRgb>

namespace patina::editor::tokens {

// Surfaces, from the deepest to the one nearest to the eye.
inline constexpr QRgb kWell = 0xff16181a;   // fields, lists
inline constexpr QRgb kWindow = 0xff1f2224; // between the docks
inline constexpr QRgb kPanel = 0xff26292c;  // docks, menus
inline constexpr QRgb kRaised = 0xff33383c; // buttons
inline constexpr QRgb kHover = 0xff3d4348;
inline constexpr QRgb kLine = 0xff393e42; // borders

inline constexpr QRgb kText = 0xffe1e4e6;
inline constexpr QRgb kTextDim = 0xffa3abb1; // labels, secondary facts: 7:1 on kPanel
inline constexpr QRgb kTextOff = 0xff6b7378; // disabled

inline constexpr QRgb kAccent = 0xff4fb8a3;     // verdigris: selection, focus, what is on
inline constexpr QRgb kAccentDeep = 0xff2a6b60; // filled selection under light text
inline constexpr QRgb kCopper = 0xffd9935f;     // warnings
inline constexpr QRgb kDanger = 0xffe5736b;     // errors

// Device-independent pixels.
inline constexpr int kGap = 8;     // between things that belong together
inline constexpr int kMargin = 12; // around them
inline constexpr int kRowHeight = 26;
inline constexpr int kRadius = 4;
inline constexpr int kFieldWidth = 76; // of a number
inline constexpr int kThumbnail = 48;  // of a map

} // namespace patina::editor::tokens
