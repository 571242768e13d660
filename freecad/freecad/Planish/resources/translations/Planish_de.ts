<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de" sourcelanguage="en">
 <context>
  <name>Planish</name>
  <message>
   <source>0 takes a thousandth of the size</source>
   <translation>0 nimmt ein Tausendstel der Größe</translation>
  </message>
  <message>
   <source>A smooth surface over a coarse mesh that keeps its sharp edges</source>
   <translation>Eine glatte Fläche über einem groben Netz, das seine scharfen Kanten behält</translation>
  </message>
  <message>
   <source>A smooth trimmed face over the selected open mesh or rows of points</source>
   <translation>Eine glatte, beschnittene Fläche über dem gewählten offenen Netz oder Reihen von Punkten</translation>
  </message>
  <message>
   <source>A solid of smooth patches from the selected mesh</source>
   <translation>Ein Volumenkörper aus glatten Flächen aus dem gewählten Netz</translation>
  </message>
  <message>
   <source>Advanced</source>
   <translation>Erweitert</translation>
  </message>
  <message>
   <source>Cancel</source>
   <translation>Abbrechen</translation>
  </message>
  <message>
   <source>Cancelled; nothing has changed</source>
   <translation>Abgebrochen; nichts hat sich geändert</translation>
  </message>
  <message>
   <source>Colours the mesh by its distance from the fitted shape</source>
   <translation>Färbt das Netz nach seinem Abstand von der angepassten Form</translation>
  </message>
  <message>
   <source>Decimate</source>
   <translation>Netz vergröbern</translation>
  </message>
  <message>
   <source>Deviation</source>
   <translation>Abweichung</translation>
  </message>
  <message>
   <source>Deviation colours</source>
   <translation>Abweichung in Farben</translation>
  </message>
  <message>
   <source>Export STEP</source>
   <translation>STEP exportieren</translation>
  </message>
  <message>
   <source>Family</source>
   <translation>Familie</translation>
  </message>
  <message>
   <source>Fewer nodes, the same shape</source>
   <translation>Weniger Knoten, dieselbe Form</translation>
  </message>
  <message>
   <source>Fit</source>
   <translation>Anpassen</translation>
  </message>
  <message>
   <source>Fit surface</source>
   <translation>Fläche anpassen</translation>
  </message>
  <message>
   <source>One surface through the selected sections, whatever their numbers of points</source>
   <translation>Eine Fläche durch die gewählten Schnitte, gleich wie viele Punkte jeder hat</translation>
  </message>
  <message>
   <source>Patches</source>
   <translation>Teilflächen</translation>
  </message>
  <message>
   <source>Preview</source>
   <translation>Vorschau</translation>
  </message>
  <message>
   <source>Sharp angle</source>
   <translation>Winkel scharfer Kanten</translation>
  </message>
  <message>
   <source>Skin sections</source>
   <translation>Fläche durch Schnitte</translation>
  </message>
  <message>
   <source>Smooth creased</source>
   <translation>Glatt mit Kanten</translation>
  </message>
  <message>
   <source>Smooth surfaces and solids from meshes and sections, within a tolerance</source>
   <translation>Glatte Flächen und Volumenkörper aus Netzen und Schnitten, innerhalb einer Toleranz</translation>
  </message>
  <message>
   <source>Exact faces</source>
   <translation>Ebenen und Zylinder genau</translation>
  </message>
  <message>
   <source>Smooth border</source>
   <translation>Rand glätten um</translation>
  </message>
  <message>
   <source>Smoothing</source>
   <translation>Glättung</translation>
  </message>
  <message>
   <source>Solid from mesh</source>
   <translation>Volumenkörper aus Netz</translation>
  </message>
  <message>
   <source>Stopping ...</source>
   <translation>Wird angehalten ...</translation>
  </message>
  <message>
   <source>Tolerance</source>
   <translation>Toleranz</translation>
  </message>
  <message>
   <source>Working ...</source>
   <translation>In Arbeit ...</translation>
  </message>
  <message>
   <source>Writes the fitted shape to a STEP file</source>
   <translation>Schreibt die angepasste Form in eine STEP-Datei</translation>
  </message>
  <message>
   <source>between the nodes</source>
   <translation>zwischen den Knoten</translation>
  </message>
  <message>
   <source>clustered rows</source>
   <translation>gedrängte Reihen</translation>
  </message>
  <message>
   <source>coarsen</source>
   <translation>vergröbern</translation>
  </message>
  <message>
   <source>control points</source>
   <translation>Kontrollpunkte</translation>
  </message>
  <message>
   <source>convert</source>
   <translation>umwandeln</translation>
  </message>
  <message>
   <source>empty cells</source>
   <translation>leere Zellen</translation>
  </message>
  <message>
   <source>error so far</source>
   <translation>Fehler bisher</translation>
  </message>
  <message>
   <source>fit</source>
   <translation>anpassen</translation>
  </message>
  <message>
   <source>folded parameters</source>
   <translation>gefaltete Parameter</translation>
  </message>
  <message>
   <source>holes filled</source>
   <translation>Löcher gefüllt</translation>
  </message>
  <message>
   <source>layout</source>
   <translation>einteilen</translation>
  </message>
  <message>
   <source>mean steps</source>
   <translation>mittlere Schritte</translation>
  </message>
  <message>
   <source>merged points</source>
   <translation>zusammengelegte Punkte</translation>
  </message>
  <message>
   <source>met</source>
   <translation>eingehalten</translation>
  </message>
  <message>
   <source>missed</source>
   <translation>verfehlt</translation>
  </message>
  <message>
   <source>of</source>
   <translation>von</translation>
  </message>
  <message>
   <source>parameterize</source>
   <translation>abwickeln</translation>
  </message>
  <message>
   <source>parameterized</source>
   <translation>abgewickelt</translation>
  </message>
  <message>
   <source>plate energy used</source>
   <translation>Plattenenergie verwendet</translation>
  </message>
  <message>
   <source>prepare</source>
   <translation>vorbereiten</translation>
  </message>
  <message>
   <source>project</source>
   <translation>projizieren</translation>
  </message>
  <message>
   <source>regularized</source>
   <translation>Parameter ausgeglichen</translation>
  </message>
  <message>
   <source>rough between nodes</source>
   <translation>rau zwischen den Knoten</translation>
  </message>
  <message>
   <source>segmentation advised</source>
   <translation>Aufteilen empfohlen</translation>
  </message>
  <message>
   <source>stagnated</source>
   <translation>Verfeinern hilft nicht mehr</translation>
  </message>
  <message>
   <source>tessellate</source>
   <translation>vernetzen</translation>
  </message>
  <message>
   <source>tolerance not met</source>
   <translation>Toleranz nicht eingehalten</translation>
  </message>
  <message>
   <source>tolerance raised</source>
   <translation>Toleranz angehoben</translation>
  </message>
  <message>
   <source>twisted rows</source>
   <translation>verdrehte Reihen</translation>
  </message>
  <message>
   <source>write</source>
   <translation>schreiben</translation>
  </message>
  <message>
   <source>zero area triangles</source>
   <translation>Dreiecke ohne Fläche</translation>
  </message>
 </context>
 <context>
  <name>PlanishPreferences</name>
  <message>
   <source>Default tolerance (0: a thousandth of the size)</source>
   <translation>Übliche Toleranz (0: ein Tausendstel der Größe)</translation>
  </message>
  <message>
   <source>General</source>
   <translation>Allgemein</translation>
  </message>
  <message>
   <source>Show deviation colours after a fit</source>
   <translation>Abweichung nach dem Anpassen in Farben zeigen</translation>
  </message>
 </context>
</TS>
