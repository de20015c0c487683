// A hinge: a pin through the knuckles of two leaves; z = 0 is the plane of symmetry, in the middle of the knuckle of the moving leaf. Lengths in mm.
//   gmsh -3 hinge.geo -o hinge.msh
SetFactory("OpenCASCADE");
Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 1;
DefineConstant[ h = 4 ];
DefineConstant[ c = 0.02 ];    // clearance of the radii
Mesh.MeshSizeMin = h/3; Mesh.MeshSizeMax = h;
Mesh.MeshSizeFromCurvature = 14;
R = 4; RO = 7;
// the moving leaf, z from 0 to 8, goes to the right; it hangs on the pin, and the pin on the fixed leaf
Cylinder(1) = {2*c,0,0, 0,0,8, RO};
Box(2) = {2*c,-RO,0, 24,3,8};
BooleanUnion(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Cylinder(4) = {2*c,0,-1, 0,0,10, R+c};
BooleanDifference(5) = { Volume{3}; Delete; }{ Volume{4}; Delete; };
// the fixed leaf, z from 8.2 to 18.2, goes to the left
Cylinder(11) = {0,0,8.2, 0,0,10, RO};
Box(12) = {-24,-RO,8.2, 24,3,10};
BooleanUnion(13) = { Volume{11}; Delete; }{ Volume{12}; Delete; };
Cylinder(14) = {0,0,8, 0,0,11, R+c};
BooleanDifference(15) = { Volume{13}; Delete; }{ Volume{14}; Delete; };
// the pin
Cylinder(21) = {c,0,0, 0,0,20, R};
Physical Volume("moving leaf") = {5};
Physical Volume("fixed leaf") = {15};
Physical Volume("pin") = {21};
e = 0.01;
Physical Surface("end of the moving leaf") = Surface In BoundingBox {24,-RO-e,-e, 25,RO,9};
Physical Surface("end of the fixed leaf") = Surface In BoundingBox {-24-e,-RO-e,8, -24+e,RO,19};
Physical Surface("plane z") = Surface In BoundingBox {-8,-8,-e, 25,8,e};
// What follows names surfaces that touch, for CalculiX alone: Mortise finds them.
Physical Surface("outside of the pin") = {15};
Physical Surface("hole of the moving leaf") = {7};
Physical Surface("hole of the fixed leaf") = {13};
