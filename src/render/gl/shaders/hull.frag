// Nothing is drawn: the stencil keeps which pixels the sector covers.
void main() {}
