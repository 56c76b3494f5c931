#pragma once

namespace vesselbench::keys {

// Keys as the window counts them: the numbers that GLFW gives them, in every shell.
inline constexpr int kSpace = 32;
inline constexpr int kMinus = 45;
inline constexpr int k0 = 48;  ///< k0 + 7 is the key 7
inline constexpr int kEqual = 61;
inline constexpr int kA = 65;  ///< kA + 25 is Z
inline constexpr int kLeftBracket = 91;
inline constexpr int kRightBracket = 93;
inline constexpr int kEscape = 256;
inline constexpr int kEnter = 257;
inline constexpr int kTab = 258;
inline constexpr int kBackspace = 259;
inline constexpr int kInsert = 260;
inline constexpr int kDelete = 261;
inline constexpr int kRight = 262;
inline constexpr int kLeft = 263;
inline constexpr int kDown = 264;
inline constexpr int kUp = 265;
inline constexpr int kPageUp = 266;
inline constexpr int kPageDown = 267;
inline constexpr int kHome = 268;
inline constexpr int kEnd = 269;
inline constexpr int kF1 = 290;
inline constexpr int kF12 = 301;
inline constexpr int kPad0 = 320;
inline constexpr int kPadSubtract = 333;
inline constexpr int kPadAdd = 334;
inline constexpr int kPadEnter = 335;

[[nodiscard]] constexpr int letter(char upper) {
    return kA + (upper - 'A');
}

}  // namespace vesselbench::keys
