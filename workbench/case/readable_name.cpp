#include "workbench/case/readable_name.h"

#include <cctype>

namespace vesselbench {

std::string readable(const std::string& name) {
    std::string words = name;
    for (char& letter : words)
        if (letter == '-' || letter == '_') letter = ' ';
    return readable_sentence(std::move(words));
}

std::string readable_sentence(std::string sentence) {
    if (!sentence.empty())
        sentence[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(sentence[0])));
    return sentence;
}

}  // namespace vesselbench
