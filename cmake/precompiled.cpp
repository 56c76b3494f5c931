// Carries the precompiled headers of all rooms (CompileOptions.cmake).
