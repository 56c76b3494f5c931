#pragma once

#include <exception>
#include <set>
#include <string>

#include "workbench/window/case/document.h"

namespace vesselbench {

/// Keeps the window going where the device lacks memory for what it should draw: that is left out,
/// and a message says why.
class DrawingGuard {
public:
    /// Runs a part of a frame. \return false if it failed
    template <class Part>
    bool run(const Part& part) {
        try {
            part();
            return true;
        } catch (const std::exception& error) {
            note(error.what());
            return false;
        }
    }

    /// Something else has failed; empty: nothing.
    void note(const std::string& problem);

    /// Problems become messages, each one once a case. Once a frame.
    void report(Document& document);

private:
    std::set<std::string> problems_, reported_;
    int case_ = 0;  ///< Document::opened()
};

}  // namespace vesselbench
