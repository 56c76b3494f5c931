#version 430 core
// Nothing is coloured: sections count surfaces in the stencil buffer.
void main() {}
