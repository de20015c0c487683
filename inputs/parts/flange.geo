// A blank cover on the flange of a pipe, held by four bolts; the quarter with one bolt. Lengths in mm.
//   gmsh -3 flange.geo -o flange.msh
SetFactory("OpenCASCADE");
Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 1;
DefineConstant[ h = 7.5 ];       // size of the elements; at the bolt less
DefineConstant[ i = 0.02 ];    // by how much the bolt is too short for what it holds
Mesh.MeshSizeMin = 0.35*h; Mesh.MeshSizeMax = h;
Mesh.MeshSizeFromCurvature = 10;
// the pipe with its flange, z from -30 to 0
Cylinder(1) = {0,0,-10, 0,0,10, 50, Pi/2};
Cylinder(2) = {0,0,-30, 0,0,30, 26, Pi/2};
BooleanUnion(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Cylinder(4) = {0,0,-31, 0,0,32, 20, Pi/2};
x = 37*Cos(Pi/4);
Cylinder(5) = {x,x,-11, 0,0,22, 4.5};
BooleanDifference(6) = { Volume{3}; Delete; }{ Volume{4,5}; Delete; };
// the cover, with a recess as wide as the pipe
Cylinder(11) = {0,0,0, 0,0,9, 50, Pi/2};
Cylinder(12) = {0,0,-1, 0,0,2, 20, Pi/2};
Cylinder(13) = {x,x,-1, 0,0,11, 4.5};
BooleanDifference(14) = { Volume{11}; Delete; }{ Volume{12,13}; Delete; };
// the bolt with head and nut
Cylinder(21) = {x,x,-16, 0,0,31, 4};
Cylinder(22) = {x,x,9-i/2, 0,0,6, 8};
Cylinder(23) = {x,x,-16, 0,0,6+i/2, 8};
BooleanUnion(24) = { Volume{21}; Delete; }{ Volume{22,23}; Delete; };
Physical Volume("flange") = {6};
Physical Volume("cover") = {14};
Physical Volume("bolt") = {24};
e = 0.005;
Physical Surface("end of the pipe") = Surface In BoundingBox {-e,-e,-30-e, 60,60,-30+e};
Physical Surface("recess") = Surface In BoundingBox {-e,-e,1-e, 21,21,1+e};
Physical Surface("plane x") = Surface In BoundingBox {-e,-e,-31, e,60,10};
Physical Surface("plane y") = Surface In BoundingBox {-e,-e,-31, 60,e,10};
// What follows names surfaces that touch, for CalculiX alone: Mortise finds them.
Physical Surface("face of the flange") = Surface In BoundingBox {-e,-e,-e, 51,51,e};
s() = Surface In BoundingBox {-e,-e,9-e, 51,51,9+e};
Physical Surface("top of the cover") = {s()};
Physical Surface("back of the flange") = Surface In BoundingBox {-e,-e,-10-e, 51,51,-10+e};
Physical Surface("seat of the head") = Surface In BoundingBox {x-9,x-9,9-i/2-e, x+9,x+9,9-i/2+e};
Physical Surface("seat of the nut") = Surface In BoundingBox {x-9,x-9,-10+i/2-e, x+9,x+9,-10+i/2+e};
Physical Surface("foot of the cover") = Surface In BoundingBox {-e,-e,-e, 51,51,e};
