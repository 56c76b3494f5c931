#include "workbench/case/readable_name.h"

#include <cctype>

namespace vesselbench {

std::string with_blanks(std::string name) {
    for (char& letter : name)
        if (letter == '-' || letter == '_') letter = ' ';
    return name;
}

std::string readable(const std::string& name) {
    return readable_sentence(with_blanks(name));
}

std::string readable_sentence(std::string sentence) {
    if (!sentence.empty())
        sentence[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(sentence[0])));
    return sentence;
}

}  // namespace vesselbench
