#pragma once

#include <array>

namespace vesselbench::icons {

// Characters of the icon font (Material Design icons), as UTF-8.
inline constexpr const char* kBranch = "\uF62C";
inline constexpr const char* kCamera = "\uF100";
inline constexpr const char* kCheck = "\uF12C";
inline constexpr const char* kClose = "\uF156";
inline constexpr const char* kColumns = "\uF56D";
inline constexpr const char* kCompare = "\uF18A";
inline constexpr const char* kCopy = "\uF18F";
inline constexpr const char* kCube = "\uF1A7";
inline constexpr const char* kCut = "\uF190";
inline constexpr const char* kDelete = "\uF1C0";
inline constexpr const char* kDone = "\uF5E0";
inline constexpr const char* kDown = "\uF140";
inline constexpr const char* kEdit = "\uF3EB";
inline constexpr const char* kError = "\uF028";
inline constexpr const char* kExport = "\uF207";
inline constexpr const char* kFile = "\uF224";
inline constexpr const char* kFit = "\uF1A4";
inline constexpr const char* kFlip = "\uF4E1";
inline constexpr const char* kFlight = "\uF01D";
inline constexpr const char* kFlat = "\uF537";
inline constexpr const char* kFolder = "\uF24B";
inline constexpr const char* kGrid = "\uF2C1";
inline constexpr const char* kHelp = "\uF625";
inline constexpr const char* kHistory = "\uF2DA";
inline constexpr const char* kHome = "\uF2DC";
inline constexpr const char* kImage = "\uF2E9";
inline constexpr const char* kInformation = "\uF2FD";
inline constexpr const char* kLayers = "\uF328";
inline constexpr const char* kLeft = "\uF141";
inline constexpr const char* kMessages = "\uF36A";
inline constexpr const char* kMoon = "\uF594";
inline constexpr const char* kNote = "\uF39E";
inline constexpr const char* kOpen = "\uF256";
inline constexpr const char* kPalette = "\uF3D8";
inline constexpr const char* kPause = "\uF3E4";
inline constexpr const char* kPending = "\uF150";
inline constexpr const char* kPerspective = "\uF1A7";
inline constexpr const char* kPlay = "\uF40A";
inline constexpr const char* kPlus = "\uF415";
inline constexpr const char* kPrepare = "\uF068";
inline constexpr const char* kPreview = "\uF208";
inline constexpr const char* kPrinter = "\uF42B";
inline constexpr const char* kRedo = "\uF44E";
inline constexpr const char* kRefresh = "\uF450";
inline constexpr const char* kRight = "\uF142";
inline constexpr const char* kRuler = "\uF46D";
inline constexpr const char* kSave = "\uF193";
inline constexpr const char* kStale = "\uF338";
inline constexpr const char* kSun = "\uF5A8";
inline constexpr const char* kTarget = "\uF4FE";
inline constexpr const char* kTextSize = "\uF27F";
inline constexpr const char* kTransparent = "\uF5CC";
inline constexpr const char* kUndo = "\uF54C";
inline constexpr const char* kUp = "\uF05D";
inline constexpr const char* kVessel = "\uF561";
inline constexpr const char* kWarning = "\uF026";
inline constexpr const char* kWater = "\uF58C";

/// All of them, for the font's texture: nothing else of the icon font is drawn.
inline constexpr std::array<unsigned short, 56> kCodes = {
    0xF01D, 0xF026, 0xF028, 0xF05D, 0xF068, 0xF100, 0xF12C, 0xF140, 0xF141, 0xF142, 0xF150, 0xF156,
    0xF18A, 0xF18F, 0xF190, 0xF193, 0xF1A4, 0xF1A7, 0xF1C0, 0xF207, 0xF208, 0xF224, 0xF24B, 0xF256,
    0xF27F, 0xF2C1, 0xF2DA, 0xF2DC, 0xF2E9, 0xF2FD, 0xF328, 0xF338, 0xF36A, 0xF39E, 0xF3D8, 0xF3E4,
    0xF3EB, 0xF40A, 0xF415, 0xF42B, 0xF44E, 0xF450, 0xF46D, 0xF4E1, 0xF4FE, 0xF537, 0xF54C, 0xF561,
    0xF56D, 0xF58C, 0xF594, 0xF5A8, 0xF5CC, 0xF5E0, 0xF625, 0xF62C};

}  // namespace vesselbench::icons
