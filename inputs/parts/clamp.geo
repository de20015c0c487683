// A band is drawn together by its ears round a tube; one half, y = 0 goes through the gap of the band. Lengths in mm.
//   gmsh -3 clamp.geo -o clamp.msh
SetFactory("OpenCASCADE");
Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 1;
DefineConstant[ h = 3.6 ];
DefineConstant[ c = 0.1 ];     // clearance of the radii
Mesh.MeshSizeMin = h/3; Mesh.MeshSizeMax = h;
Mesh.MeshSizeFromCurvature = 32;
// the tube, from z = -8 to 20
Cylinder(1) = {0,0,-8, 0,0,28, 20, Pi};
Cylinder(2) = {0,0,-9, 0,0,30, 17.5, Pi};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
// the band, from z = 0 to 10, its gap at x > 0
Cylinder(11) = {0,0,0, 0,0,10, 23+c, Pi};
Box(12) = {20.1+c,2,0, 13,5,10};
BooleanUnion(13) = { Volume{11}; Delete; }{ Volume{12}; Delete; };
Cylinder(14) = {0,0,-1, 0,0,12, 20+c};
Box(15) = {0,-1,-1, 40,3,12};
BooleanDifference(16) = { Volume{13}; Delete; }{ Volume{14,15}; Delete; };
Physical Volume("tube") = {3};
Physical Volume("band") = {16};
e = 0.01;
Physical Surface("end of the tube") = Surface In BoundingBox {-21,-e,20-e, 21,21,20+e};
Physical Surface("ear") = Surface In BoundingBox {20,7-e,-e, 40,7+e,10+e};
Physical Surface("plane y") = Surface In BoundingBox {-40,-e,-9, 40,e,21};
// What follows names surfaces that touch, for CalculiX alone: Mortise finds them.
Physical Surface("outside of the tube") = {1};
Physical Surface("inside of the band") = {12};
