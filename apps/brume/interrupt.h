// Ctrl-C (SIGINT), SIGTERM and SIGHUP: the first asks to finish soon, the second ends the program at once.
#pragma once

// Before it is called, each ends the program; one that is ignored stays ignored.
void watch_for_interrupt();
bool interrupted();
