#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "workbench/window/features/review/review_feature.h"
#include "workbench/window/shell/offscreen_shell.h"

namespace vesselbench::test {

[[nodiscard]] ReviewFeature& feature_of(OffscreenShell& shell);

/// A tube of 4 mm radius that was loaded as edit 1 and smoothed by edit 2, in the review step.
[[nodiscard]] std::unique_ptr<OffscreenShell> reviewed_tube();

/// Edit 3, which shrinks the tube.
void smooth_strongly(OffscreenShell& shell);

[[nodiscard]] ReviewStatus status_of_edit(OffscreenShell& shell, EditId id);

/// A. Kern, radiologist.
void say_who(OffscreenShell& shell);

/// Scrolls the panel until an item is seen. \return false if it never is
bool reveal(OffscreenShell& shell, const std::string& item);

/// Reveals an item of the panel and clicks it. \return as OffscreenShell::click_item
bool click_in_panel(OffscreenShell& shell, const std::string& item);

void click_and_wait(OffscreenShell& shell, const std::string& item);

/// Answers the question for a file.
void answer_and_wait(OffscreenShell& shell, const std::filesystem::path& file);

/// What the page would save of the shown review: a pin and a distance on edit 2, which is rejected.
[[nodiscard]] VerdictFile file_of_roth(OffscreenShell& shell);

[[nodiscard]] std::filesystem::path beside_project(OffscreenShell& shell, const std::string& name);

/// Enters file_of_roth() by clicks.
void import_roth(OffscreenShell& shell);

}  // namespace vesselbench::test
